#include "apps/terrane/window/name_tags.h"

#include <imgui.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/line_of_sight.h"
#include "apps/terrane/window/screen_projection.h"

namespace terrane::app {
namespace {

constexpr double kOverHead = world::kCharacterHeight - world::kEyeHeight + 0.15;  // blocks over the eyes
// Names up to kFullSize blocks away have full size; the size falls to kLeastSize at kNameDistance.
constexpr double kFullSize = 6;
constexpr float kLeastSize = 0.6f;
constexpr double kFadesFrom = 36;  // blocks

// 1 up to `from` blocks, 0 at kNameDistance.
float nearness(double distance, double from) {
    return static_cast<float>(glm::clamp((kNameDistance - distance) / (kNameDistance - from), 0.0, 1.0));
}

void drawName(ImDrawList& draw, const ShownName& shown) {
    const std::string& name = shown.tag->name;
    const char* end = name.data() + name.size();
    const ImFont& font = *ImGui::GetFont();
    const float height = shown.size * ImGui::GetFontSize(), pad = 3 * uiScale() * shown.size;
    const ImVec2 size = font.CalcTextSizeA(height, FLT_MAX, 0, name.data(), end);
    const ImVec2 corner{shown.at.x - size.x / 2, shown.at.y - size.y - pad};
    const auto faded = [&](int alpha) { return static_cast<int>(shown.alpha * static_cast<float>(alpha)); };
    draw.AddRectFilled({corner.x - 2 * pad, corner.y - pad},
                       {corner.x + size.x + 2 * pad, corner.y + size.y + pad},
                       IM_COL32(10, 12, 16, faded(130)), 2 * pad);
    draw.AddText(&font, height, corner, IM_COL32(255, 255, 255, faded(255)), name.data(), end);
}

}  // namespace

std::vector<ShownName> shownNames(const Screen& screen, const render::Camera& camera,
                                  std::span<const NameTag> names, const NamesView& view) {
    const ScreenProjection projection({screen.width, screen.height}, camera);
    struct Near {
        double distance;
        const NameTag* tag;
    };
    std::vector<Near> near;
    for (const NameTag& tag : names) {
        const double distance = glm::distance(tag.eyes, camera.position);
        if (distance < kNameDistance && distance > 0) near.push_back({distance, &tag});
    }
    std::ranges::stable_sort(near, {}, &Near::distance);
    if (near.size() > kMostNames) near.resize(kMostNames);
    std::vector<ShownName> shown;
    for (auto it = near.rbegin(); it != near.rend(); ++it) {
        const auto at = projection.at(it->tag->eyes + glm::dvec3(0, 0, kOverHead));
        if (!at || at->x < 0 || at->x > screen.width || at->y < 0 || at->y > screen.height) continue;
        if (!isInSight(view.world, view.blocks, camera.position, it->tag->eyes)) continue;
        shown.push_back({it->tag, *at, glm::mix(kLeastSize, 1.0f, nearness(it->distance, kFullSize)),
                         nearness(it->distance, kFadesFrom)});
    }
    return shown;
}

void drawNames(const Screen& screen, const render::Camera& camera, std::span<const NameTag> names,
               const NamesView& view) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (const ShownName& shown : shownNames(screen, camera, names, view)) drawName(draw, shown);
}

}  // namespace terrane::app
