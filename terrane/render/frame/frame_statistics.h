// Statistics of a frame. It is a plain value.
#pragma once

#include <cstddef>
#include <string_view>

#include "terrane/gpu/timer.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {

// GPU memory of a renderer by use, in bytes. It is a plain value.
struct GpuMemory {
    std::size_t quads = 0, light = 0;  // buffers and textures, including free room
    std::size_t rays = 0;              // blocks, and the cells that stop rays
    std::size_t meshSections = 0;      // records, their order, draw commands
    std::size_t textures = 0;          // of blocks and sky
    std::size_t targets = 0;           // G-buffer, shadow map, layers and so on
    std::size_t staging = 0;           // of the mesher on the GPU

    std::size_t world() const { return quads + light + rays + meshSections; }  // grows with the view distance
    std::size_t fixed() const { return textures + targets + staging; }
    std::size_t total() const { return world() + fixed(); }
};

// Sums over the early and the late pass: mesh sections drawn by both count twice. Quads that are not
// listed do not count. A draw command counts even if its list, which the GPU makes, is empty.
struct FrameStatistics {
    std::size_t meshSections = 0, quads = 0, drawCommands = 0;
    std::size_t opaqueTriangles = 0, transparentTriangles = 0;  // of these, alpha-tested ones are opaque
    std::size_t shadowTriangles = 0;                            // drawn into shadow maps, without those above
};

FrameStatistics statisticsOf(const shared::DrawCounts& counts, std::size_t shadowTriangles);

// Timer zone of a part of a frame. The renderer uses it on the context's thread. Measures the GPU time of
// commands during its life.
class TimerZone {
  public:
    TimerZone(gpu::GpuTimer& timer, std::string_view name) : timer_(timer) { timer_.begin(name); }
    ~TimerZone() { timer_.end(); }
    TimerZone(const TimerZone&) = delete;
    TimerZone& operator=(const TimerZone&) = delete;

  private:
    gpu::GpuTimer& timer_;
};

}  // namespace terrane::render
