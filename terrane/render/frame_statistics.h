// Statistics of a frame. A plain value.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "terrane/shared/mesh_section.h"

namespace terrane::render {

// The passes whose GPU time is measured, in the order of a frame. Options leave some out.
constexpr std::array<std::string_view, 16> kPassNames = {
    "cull",         "shadow map", "surfaces",          "depth pyramid", "cull again", "surfaces again",
    "fill holes",   "figures",    "ambient occlusion", "sky",           "shade",      "peel",
    "shade layers", "god rays",   "depth of field",    "final"};

// Sums over the early and the late pass: mesh sections drawn by both count twice. Quads left out by
// quad_list.h do not count. A draw command counts even if its list is empty.
struct FrameStatistics {
    std::size_t meshSections = 0, quads = 0, drawCommands = 0;
    std::size_t opaqueTriangles = 0, transparentTriangles = 0;  // of these, alpha-tested ones are opaque
    std::size_t shadowTriangles = 0;                            // drawn into shadow maps, without those above
};

FrameStatistics statisticsOf(const shared::DrawCounts& counts, std::size_t shadowTriangles);

}  // namespace terrane::render
