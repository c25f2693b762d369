#include "terrane/game/item_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "terrane/base/text.h"

namespace terrane::game {
namespace {

constexpr const char* kGive = "give";
constexpr const char* kMode = "mode";
constexpr int kMaxGiven = 999;

std::vector<std::string> wordsIn(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

std::optional<int> countIn(const std::string& word) {
    int count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    const bool isGood = error == std::errc() && end == word.data() + word.size();
    return isGood ? std::optional(count) : std::nullopt;
}

// Takes a player's name, which may have spaces, from the words at `first`.
std::string nameFrom(const std::vector<std::string>& words, std::size_t first) {
    std::string name;
    for (std::size_t k = first; k < words.size(); ++k) name += (name.empty() ? "" : " ") + words[k];
    return name;
}

std::optional<PlayerId> playerNamed(const std::map<PlayerId, std::string>& names, PlayerId own,
                                    const std::string& name) {
    if (name.empty()) return own;
    for (const auto& [id, known] : names)
        if (known == name) return id;
    return std::nullopt;
}

}  // namespace

ItemCommands::ItemCommands(Session& session, MayCommand may) : session_(session), may_(std::move(may)) {
    joined_ =
        session.events.joined.add([this](const PlayerJoined& event) { names_[event.player] = event.name; });
    left_ = session.events.left.add([this](const PlayerLeft& event) { names_.erase(event.player); });
    session.chatCommands.push_back(
        {kGive, "ITEM [COUNT] [PLAYER]", "gives items",
         [this](PlayerId player, const std::string& arguments) { return give(player, arguments); }});
    session.chatCommands.push_back(
        {kMode, "creative|survival|world [PLAYER]", "sets the mode of a player; world: the world's",
         [this](PlayerId player, const std::string& arguments) { return setMode(player, arguments); }});
}

ItemCommands::~ItemCommands() {
    std::erase_if(session_.chatCommands, [](const ChatCommand& command) {
        return command.owner.empty() && (command.name == kGive || command.name == kMode);
    });
}

std::string ItemCommands::give(PlayerId player, const std::string& arguments) {
    if (!may_(player)) return "only operators can give items";
    const std::vector<std::string> words = wordsIn(arguments);
    if (words.empty()) return "usage: /give ITEM [COUNT] [PLAYER]";
    const world::ItemTable& table = session_.blocks().items();
    if (!table.find(words[0])) {
        std::vector<std::string> names;
        for (const world::ItemType& type : table.types()) names.push_back(type.name);
        return fmt::format("there is no item {}{}", base::printable(words[0]),
                           base::didYouMean(words[0], names));
    }
    const auto count = words.size() > 1 ? countIn(words[1]) : std::nullopt;
    if (count && (*count < 1 || *count > kMaxGiven))
        return fmt::format("a count from 1 to {}, not {}", kMaxGiven, *count);
    const std::string name = nameFrom(words, count ? 2 : 1);
    const auto to = playerNamed(names_, player, name);
    if (!to) return fmt::format("no player called {} is here", name);
    const auto wanted = static_cast<std::uint16_t>(count.value_or(1));
    const int left = session_.give(*to, {words[0], wanted});
    if (left == 0) return fmt::format("gave {} {}", wanted, words[0]);
    return fmt::format("gave {} {}; there is no room for {} more", wanted - left, words[0], left);
}

std::string ItemCommands::setMode(PlayerId player, const std::string& arguments) {
    if (!may_(player)) return "only operators can set modes";
    const std::vector<std::string> words = wordsIn(arguments);
    const auto mode = words.empty() ? std::nullopt : modeNamed(words[0]);
    if (words.empty() || (!mode && words[0] != "world"))
        return "usage: /mode creative|survival|world [PLAYER]";
    const std::string name = nameFrom(words, 1);
    const auto to = playerNamed(names_, player, name);
    if (!to) return fmt::format("no player called {} is here", name);
    session_.setMode(*to, mode);
    const Mode now = session_.modeOf(*to);
    return fmt::format("{} in {}", name.empty() ? "you are" : name + " is",
                       kModeNames[static_cast<std::size_t>(now)]);
}

}  // namespace terrane::game
