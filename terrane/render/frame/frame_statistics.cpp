#include "terrane/render/frame/frame_statistics.h"

#include "terrane/mesh/draw_bucket.h"

namespace terrane::render {

FrameStatistics statisticsOf(const shared::DrawCounts& counts, std::size_t shadowTriangles) {
    FrameStatistics statistics{.meshSections = counts.meshSections, .shadowTriangles = shadowTriangles};
    for (shared::uint list = 0; list < shared::kDrawLists; ++list) {
        const bool isBlended = mesh::bucketAlphaClass(static_cast<int>(list)) == mesh::AlphaClass::Blended;
        statistics.quads += counts.quads[list];
        statistics.drawCommands += counts.commands[list];
        (isBlended ? statistics.transparentTriangles : statistics.opaqueTriangles) +=
            2 * std::size_t{counts.quads[list]};
    }
    return statistics;
}

}  // namespace terrane::render
