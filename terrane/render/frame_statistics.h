// What a frame drew, for people to read. A plain value.
#pragma once

#include <cstddef>

#include "terrane/shared/mesh_section.h"

namespace terrane::render {

struct FrameStatistics {
    std::size_t meshSections = 0, quads = 0, drawCommands = 0;
    std::size_t opaqueTriangles = 0, transparentTriangles = 0;  // of these, alpha-tested ones are opaque
};

FrameStatistics statisticsOf(const shared::DrawCounts& counts);

}  // namespace terrane::render
