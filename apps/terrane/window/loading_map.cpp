#include "apps/terrane/window/loading_map.h"

#include <imgui.h>

#include <algorithm>

namespace terrane::app {
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

void drawLoadingMap(const Screen& screen, const stream::ChunkPipeline& pipeline,
                    const stream::TileTable& tiles) {
    const world::ChunkPos center = tiles.view.center;
    const int around = tiles.view.viewDistance + 3, reach = std::max(around, tiles.view.horizon);
    const float side = std::min(screen.width, screen.height) * 0.6f;
    const float cell = side / static_cast<float>(2 * reach + 1);
    const float left = (screen.width - side) / 2, top = (screen.height - side) / 2;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({left, top}, {left + side, top + side}, IM_COL32(10, 12, 16, 170));
    // A square of chunks of level 0. As on all maps north, -y, is up, and east, -x, to the right.
    const auto square = [&](world::ChunkPos first, int width, ImU32 color) {
        const auto at = [&](int chunks) {
            return static_cast<float>(std::clamp(chunks, 0, 2 * reach + 1)) * cell;
        };
        const int x = center.x - (first.x + width - 1) + reach, y = first.y - center.y + reach;
        const float gap = cell * static_cast<float>(width) > 4 ? 1.0f : 0.0f;
        draw.AddRectFilled({left + at(x), top + at(y)},
                           {left + at(x + width) - gap, top + at(y + width) - gap}, color);
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
    draw.AddText(
        {left + 6, top + side + 4}, IM_COL32_WHITE,
        "red: loading   yellow: there   blue: lit and meshed now   green: visible\ndarker green: coarser");
}

}  // namespace terrane::app
