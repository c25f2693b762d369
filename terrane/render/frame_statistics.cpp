#include "terrane/render/frame_statistics.h"

#include "terrane/mesh/draw_bucket.h"

namespace terrane::render {

FrameStatistics statisticsOf(const shared::DrawCounts& counts) {
    FrameStatistics statistics{counts.meshSections, 0, 0, 0, 0};
    for (shared::uint list = 0; list < shared::kCameraLists; ++list) {
        const bool isBlended = mesh::bucketAlphaClass(static_cast<int>(list)) == mesh::AlphaClass::Blended;
        statistics.quads += counts.quads[list];
        statistics.drawCommands += counts.commands[list];
        (isBlended ? statistics.transparentTriangles : statistics.opaqueTriangles) +=
            2 * std::size_t{counts.quads[list]};
    }
    return statistics;
}

}  // namespace terrane::render
