#include "apps/terrane/window/compass.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "apps/terrane/window/imgui_layer.h"

namespace terrane::app {
namespace {

constexpr double kSpan = 150;  // degrees from end to end
constexpr ImU32 kPlaceColor = IM_COL32(255, 205, 90, 255);

// The position in the strip, -1 … 1; values beyond are outside of it.
double placeInStrip(double degrees, double ahead) {
    return std::remainder(degrees - ahead, 360.0) / (kSpan / 2);
}

void drawCentered(ImDrawList& draw, ImVec2 at, ImU32 color, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    draw.AddText({at.x - size.x / 2 + 1, at.y + 1}, IM_COL32(0, 0, 0, 160), text.c_str());
    draw.AddText({at.x - size.x / 2, at.y}, color, text.c_str());
}

std::string distanceText(double blocks) {
    return blocks < 1000 ? fmt::format("{:.0f} m", blocks) : fmt::format("{:.1f} km", blocks / 1000);
}

}  // namespace

void drawCompass(const Screen& screen, const world::Pose& pose, std::span<const game::Place> places) {
    const float scale = uiScale(), half = std::min(170 * scale, screen.width * 0.35f);
    const float middle = screen.width / 2, top = 8 * scale, height = 20 * scale;
    const double ahead = game::compassDegrees(pose.yaw);
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({middle - half, top}, {middle + half, top + height}, IM_COL32(10, 12, 16, 120),
                       6 * scale);
    constexpr const char* kNames[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
    for (int step = 0; step < 24; ++step) {
        const double at = placeInStrip(step * 15.0, ahead);
        if (std::abs(at) > 0.96) continue;
        const float x = middle + static_cast<float>(at) * half;
        if (step % 3 == 0)
            drawCentered(draw, {x, top + 3 * scale}, IM_COL32(255, 255, 255, step % 6 == 0 ? 255 : 170),
                         kNames[step / 3]);
        else
            draw.AddLine({x, top + 7 * scale}, {x, top + 13 * scale}, IM_COL32(255, 255, 255, 110), scale);
    }
    // The place nearest to the view direction is labeled with its name and distance.
    const game::Place* nearest = nullptr;
    double nearestAt = 0.12;
    for (const game::Place& place : places) {
        const glm::dvec3 to = place.pose.position - pose.position;
        const double at = placeInStrip(game::compassDegrees(to.x, to.y), ahead);
        if (std::abs(at) > 0.97) continue;
        const float x = middle + static_cast<float>(at) * half, y = top + height;
        draw.AddTriangleFilled({x - 4 * scale, y + 5 * scale}, {x + 4 * scale, y + 5 * scale}, {x, y - scale},
                               kPlaceColor);
        if (std::abs(at) > nearestAt) continue;
        nearest = &place;
        nearestAt = std::abs(at);
    }
    if (!nearest) return;
    const glm::dvec3 to = nearest->pose.position - pose.position;
    drawCentered(draw, {middle, top + height + 7 * scale}, kPlaceColor,
                 nearest->name + "  " + distanceText(std::hypot(to.x, to.y)));
}

}  // namespace terrane::app
