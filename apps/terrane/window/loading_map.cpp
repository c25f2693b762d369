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

}  // namespace

void drawLoadingMap(const Screen& screen, const stream::ChunkPipeline& pipeline, world::ChunkPos center,
                    int viewDistance) {
    const int reach = viewDistance + 3;
    const float side = std::min(screen.width, screen.height) * 0.6f;
    const float cell = side / static_cast<float>(2 * reach + 1);
    const float left = (screen.width - side) / 2, top = (screen.height - side) / 2;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({left, top}, {left + side, top + side}, IM_COL32(10, 12, 16, 170));
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const auto stage = pipeline.stageAt({center.x + x, center.y + y});
            if (!stage) continue;
            // North, the direction of y, is up.
            const float px = left + static_cast<float>(x + reach) * cell;
            const float py = top + static_cast<float>(reach - y) * cell;
            const float gap = cell > 4 ? 1.0f : 0.0f;
            draw.AddRectFilled({px, py}, {px + cell - gap, py + cell - gap}, colorOf(*stage));
        }
    }
    const float middle = left + static_cast<float>(reach) * cell;
    draw.AddRect({middle, top + static_cast<float>(reach) * cell},
                 {middle + cell, top + static_cast<float>(reach + 1) * cell}, IM_COL32(255, 255, 255, 255));
    draw.AddText({left + 6, top + side + 4}, IM_COL32(255, 255, 255, 255),
                 "red: loading   yellow: there   blue: lit and meshed now   green: visible");
}

}  // namespace terrane::app
