#include "apps/terrane/former_names.h"

#include <algorithm>
#include <array>

namespace terrane::app {
namespace {

struct Renamed {
    std::string_view former, current;
};

constexpr std::array<Renamed, 1> kCommands = {{{"fly", "flight-bench"}}};
constexpr std::array<Renamed, 7> kFlags = {{{"aggregation", "merging"},
                                            {"atmosphere", "distance-fog"},
                                            {"better-texturing", "sharp-filtering"},
                                            {"for", "duration"},
                                            {"position", "bookmark"},
                                            {"region-height", "mesh-section-height"},
                                            {"save-game", "world"}}};
constexpr std::array<Renamed, 1> kValues = {{{"aggregation", "merging"}}};  // of --view

std::string_view currentIn(std::span<const Renamed> names, std::string_view name) {
    const auto found = std::ranges::find(names, name, &Renamed::former);
    return found != names.end() ? found->current : name;
}

std::string withCurrentFlag(std::string_view argument) {
    if (!argument.starts_with("--")) return std::string(argument);
    const std::string_view name = argument.substr(2, argument.find('=') - 2);
    return std::string("--").append(currentFlag(name)).append(argument.substr(2 + name.size()));
}

}  // namespace

std::string_view currentFlag(std::string_view name) {
    return currentIn(kFlags, name);
}

std::string_view currentValue(std::string_view value) {
    return currentIn(kValues, value);
}

std::vector<std::string> withCurrentNames(std::span<const char* const> arguments) {
    std::vector<std::string> current;
    for (const char* argument : arguments) current.push_back(withCurrentFlag(argument));
    if (current.size() > 1) current[1] = currentIn(kCommands, current[1]);
    return current;
}

}  // namespace terrane::app
