#include "terrane/game/block_palette.h"

#include <algorithm>
#include <sstream>

#include "terrane/game/hotbar.h"

namespace terrane::game {
namespace {

// ASCII only: other letters are compared as they are.
std::string lowered(std::string_view text) {
    std::string low(text);
    std::ranges::transform(
        low, low.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return low;
}

std::vector<std::string> wordsOf(std::string_view text) {
    std::istringstream in(lowered(text));
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

}  // namespace

std::vector<std::string> paletteGroups(const world::BlockRegistry& blocks) {
    std::vector<std::string> groups;
    for (const world::BlockType& type : blocks.types())
        if (isBuilt(type, blocks) && std::ranges::find(groups, type.group) == groups.end())
            groups.push_back(type.group);
    return groups;
}

std::vector<world::BlockId> paletteBlocks(const world::BlockRegistry& blocks, const PaletteFilter& filter) {
    const std::vector<std::string> words = wordsOf(filter.search);
    std::vector<world::BlockId> first, others;
    for (const world::BlockType& type : blocks.types()) {
        if (!isBuilt(type, blocks) || (!filter.group.empty() && type.group != filter.group)) continue;
        const std::string shown = lowered(filter.shownName(type.id)), text = shown + " " + type.name;
        const bool fits = std::ranges::all_of(
            words, [&](const std::string& word) { return text.find(word) != std::string::npos; });
        if (!fits) continue;
        (words.empty() || shown.starts_with(words.front()) ? first : others).push_back(type.id);
    }
    first.insert(first.end(), others.begin(), others.end());
    return first;
}

}  // namespace terrane::game
