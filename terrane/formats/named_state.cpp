#include "terrane/formats/named_state.h"

#include <algorithm>

namespace terrane::formats {

const std::string* NamedState::property(std::string_view property) const {
    for (const auto& entry : properties)
        if (entry.first == property) return &entry.second;
    return nullptr;
}

void NamedState::set(std::string_view property, std::string value) {
    const auto place = std::ranges::lower_bound(
        properties, property, {}, [](const auto& entry) { return std::string_view(entry.first); });
    if (place != properties.end() && place->first == property)
        place->second = std::move(value);
    else
        properties.insert(place, {std::string(property), std::move(value)});
}

std::string textOf(const NamedState& state) {
    std::string text = state.name;
    for (std::size_t k = 0; k < state.properties.size(); ++k) {
        text += k == 0 ? '[' : ',';
        text += state.properties[k].first;
        text += '=';
        text += state.properties[k].second;
    }
    if (!state.properties.empty()) text += ']';
    return text;
}

std::optional<NamedState> namedState(std::string_view text) {
    NamedState state;
    const std::size_t bracket = text.find('[');
    const std::string_view name = text.substr(0, bracket);
    if (name.empty()) return std::nullopt;
    state.name =
        name.find(':') == std::string_view::npos ? "minecraft:" + std::string(name) : std::string(name);
    if (bracket == std::string_view::npos) return state;
    std::string_view rest = text.substr(bracket + 1);
    if (!rest.ends_with(']')) return std::nullopt;
    rest.remove_suffix(1);
    while (!rest.empty()) {
        const std::string_view pair = rest.substr(0, rest.find(','));
        const std::size_t equals = pair.find('=');
        if (equals == std::string_view::npos || equals == 0) return std::nullopt;
        state.set(pair.substr(0, equals), std::string(pair.substr(equals + 1)));
        rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    }
    return state;
}

}  // namespace terrane::formats
