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

    // The value of the property; null if there is none.
    const std::string* property(std::string_view property) const;
    // Sets the property; the order by name is kept.
    void set(std::string_view property, std::string value);
    bool operator==(const NamedState&) const = default;
};

// The text form of schematics. The reverse of namedState() if no name holds any of "[]=,".
std::string textOf(const NamedState& state);
// Parses the text form. A name without namespace gets "minecraft:". Nothing if the text is invalid: an empty
// name, a bracket that does not close, a property without value.
std::optional<NamedState> namedState(std::string_view text);

}  // namespace terrane::formats
