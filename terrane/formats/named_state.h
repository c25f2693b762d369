// A block as other programs name it: "minecraft:oak_stairs[facing=east,half=bottom]". Plain values; any
// thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane::formats {

struct NamedState {
    std::string name;                                             // with its namespace
    std::vector<std::pair<std::string, std::string>> properties;  // by name, each once

    // The property's value; nothing where it has none.
    const std::string* property(std::string_view property) const;
    // Sets it in its place.
    void set(std::string_view property, std::string value);
    bool operator==(const NamedState&) const = default;
};

// As in a schematic. The reverse of namedState() where no name holds any of "[]=,".
std::string textOf(const NamedState& state);
// A name without namespace is one of "minecraft:". Nothing where the text is none: an empty name, a bracket
// that does not close, a property without value.
std::optional<NamedState> namedState(std::string_view text);

}  // namespace terrane::formats
