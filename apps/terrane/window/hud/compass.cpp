#include "apps/terrane/window/hud/compass.h"

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

void drawCompass(OverlayLayout& layout, const world::Pose& pose, std::span<const game::Place> places) {
    const float scale = uiScale(), half = std::min(170 * scale, layout.screen().width * 0.35f);
    const float height = 20 * scale, below = places.empty() ? 0 : 9 * scale + ImGui::GetFontSize();
    // At the top, or below a notice there; under a dialog nowhere else.
    const auto rect = layout.place(
        "compass", {.size = {2 * half, height + below}, .alignX = 0.5f, .reach = layout.screen().height / 3});
    if (!rect) return;
    const float middle = (rect->min.x + rect->max.x) / 2, top = rect->min.y;
    const double ahead = game::compassDegrees(pose.yaw);
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const OverlayClip clip(draw, *rect);
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
    drawCentered(draw, {middle, top + height + 7 * scale}, kPlaceColor,
                 nearest->name + "  " + distanceText(game::distanceBetween(pose, nearest->pose)));
}

namespace {

ImU32 colorOf(stream::ChunkStage stage) {
    switch (stage) {
        case stream::ChunkStage::Loading:
            return IM_COL32(200, 60, 50, 220);
        case stream::ChunkStage::Loaded:
            return IM_COL32(220, 160, 40, 220);
        case stream::ChunkStage::Lighting:
            return IM_COL32(70, 130, 230, 220);
        case stream::ChunkStage::Visible:
            return IM_COL32(70, 180, 80, 220);
    }
    return 0;
}

// Shades of green, darker for coarser levels.
ImU32 colorOf(int level) {
    const float share = 1.0f / (1.0f + 0.25f * static_cast<float>(level));
    return IM_COL32(static_cast<int>(70 * share), static_cast<int>(180 * share), static_cast<int>(80 * share),
                    220);
}

}  // namespace

void drawLoadingMap(OverlayLayout& layout, const stream::ChunkPipeline& pipeline,
                    const stream::TileTable& tiles) {
    const world::ChunkPos center = tiles.view.center;
    const int around = tiles.view.viewDistance + 3, reach = std::max(around, tiles.view.horizon);
    constexpr const char* kLegend =
        "red: loading   yellow: there   blue: lit and meshed now   green: visible\ndarker green: coarser";
    const float wanted = std::min(layout.screen().width, layout.screen().height) * 0.6f, gap = 4 * uiScale();
    const ImVec2 legend = ImGui::CalcTextSize(kLegend, nullptr, false, layout.widest());
    const auto rect =
        layout.place("loading map", {.size = {std::max(wanted, legend.x), wanted + gap + legend.y},
                                     .alignX = 0.5f,
                                     .top = (layout.screen().height - wanted) / 2,
                                     .minHeight = wanted / 3 + gap + legend.y});
    if (!rect) return;
    const float side = std::min(rect->width(), rect->height() - gap - legend.y);
    const float cell = side / static_cast<float>(2 * reach + 1);
    const float left = (rect->min.x + rect->max.x - side) / 2, top = rect->min.y;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const OverlayClip clip(draw, *rect);
    draw.AddRectFilled({left, top}, {left + side, top + side}, IM_COL32(10, 12, 16, 170));
    // A square of chunks of level 0. As on all maps north, -y, is up, and east, -x, to the right.
    const auto square = [&](world::ChunkPos first, int width, ImU32 color) {
        const auto at = [&](int chunks) {
            return static_cast<float>(std::clamp(chunks, 0, 2 * reach + 1)) * cell;
        };
        const int x = center.x - (first.x + width - 1) + reach, y = first.y - center.y + reach;
        const float line = cell * static_cast<float>(width) > 4 ? 1.0f : 0.0f;
        draw.AddRectFilled({left + at(x), top + at(y)},
                           {left + at(x + width) - line, top + at(y + width) - line}, color);
    };
    for (const auto& [pos, record] : tiles.records) {
        if (pos.level == 0 || !record.isShown) continue;
        square({pos.x << pos.level, pos.y << pos.level}, 1 << pos.level, colorOf(pos.level));
    }
    for (int y = -around; y <= around; ++y) {
        for (int x = -around; x <= around; ++x) {
            const world::ChunkPos pos = world::offsetBy(center, x, y);
            if (const auto stage = pipeline.stageAt(pos)) square(pos, 1, colorOf(*stage));
        }
    }
    const float own = static_cast<float>(reach) * cell;
    draw.AddRect({left + own, top + own}, {left + own + cell, top + own + cell}, IM_COL32_WHITE);
    draw.AddText(nullptr, 0, {rect->min.x, top + side + gap}, IM_COL32_WHITE, kLegend, nullptr,
                 layout.widest());
}

}  // namespace terrane::app
