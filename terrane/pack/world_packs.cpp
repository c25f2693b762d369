#include "terrane/pack/world_packs.h"

#include <sstream>
#include <utility>

#include "terrane/base/printable.h"
#include "terrane/pack/pack_archive.h"

namespace terrane::pack {
namespace {

constexpr std::string_view kPacksMetadata = "packs";
constexpr std::size_t kMaxWorldPacks = 256;

std::string nameIn(const std::string& line) {
    return line.substr(0, line.find(' '));
}

std::vector<std::string> linesOf(const std::string& metadata) {
    std::vector<std::string> lines;
    std::istringstream text(metadata);
    for (std::string line; std::getline(text, line) && lines.size() < kMaxWorldPacks;)
        if (isPackName(nameIn(line))) lines.push_back(line);
    return lines;
}

}  // namespace

std::vector<std::string> rememberedPacks(const store::Metadata& metadata) {
    const auto found = metadata.find(kPacksMetadata);
    std::vector<std::string> names;
    if (found != metadata.end())
        for (const std::string& line : linesOf(found->second)) names.push_back(nameIn(line));
    return names;
}

void rememberPacks(store::ChunkStore& store, const Content& content) {
    const std::string before = store.metadata(kPacksMetadata).value_or("");
    std::string lines;
    for (const Pack& pack : *content.packs)
        if (pack.info.name != kBuiltInPack)
            lines += fmt::format("{} {} {}\n", pack.info.name,
                                 pack.info.version.empty() ? "-" : base::printable(pack.info.version),
                                 hexOf(hashOf(pack)));
    // The world may still have blocks of packs that are not loaded now.
    for (const std::string& line : linesOf(before))
        if (!hasPack(*content.packs, nameIn(line))) lines += line + "\n";
    if (before != lines) store.setMetadata(kPacksMetadata, std::move(lines));
}

}  // namespace terrane::pack
