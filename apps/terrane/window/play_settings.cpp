#include "apps/terrane/window/play_settings.h"

#include <fmt/format.h>

#include <array>

namespace terrane::app {
namespace {

template <class T>
std::string wordOf(std::span<const std::pair<std::string, T>> words, T value) {
    for (const auto& [word, meaning] : words) {
        if (meaning == value) return word;
    }
    return {};
}

}  // namespace

std::span<const std::pair<std::string, Movement>> movementWords() {
    static const std::array<std::pair<std::string, Movement>, 4> words = {{{"fast", Movement::Fast},
                                                                           {"medium", Movement::Medium},
                                                                           {"walls", Movement::Walls},
                                                                           {"gravity", Movement::Gravity}}};
    return words;
}

std::span<const std::pair<std::string, mesh::Method>> aggregationWords() {
    using mesh::Method;
    static const std::array<std::pair<std::string, Method>, 5> words = {{{"none", Method::None},
                                                                         {"lines", Method::Lines},
                                                                         {"squares", Method::Squares},
                                                                         {"squares-ext", Method::SquaresExt},
                                                                         {"greedy", Method::Greedy}}};
    return words;
}

SettingValues valuesOf(const PlaySettings& s, bool isSoftwareRenderer) {
    SettingValues values = {{"preset", s.preset}};
    const render::RenderOptions preset = renderOptions({s.preset, {}}, isSoftwareRenderer);
    for (const GraphicsRow& row : graphicsTable()) {
        const int word = row.get(s.graphics);
        if (word == row.get(preset)) continue;
        values.emplace_back(row.name, row.words[static_cast<std::size_t>(word)]);
    }
    values.emplace_back("view-distance", fmt::format("{}", s.viewDistance));
    values.emplace_back("aggregation", wordOf(aggregationWords(), s.mesh.method));
    values.emplace_back("region-height", fmt::format("{}", s.mesh.regionHeight));
    values.emplace_back("movement", wordOf(movementWords(), s.movement));
    values.emplace_back("field-of-view", fmt::format("{:.0f}", s.fieldOfView));
    values.emplace_back("mouse-sensitivity", fmt::format("{:.2f}", s.mouseSensitivity));
    values.emplace_back("day-minutes", fmt::format("{:.1f}", s.dayMinutes));
    if (s.fullScreen) values.emplace_back("full-screen", "true");
    return values;
}

}  // namespace terrane::app
