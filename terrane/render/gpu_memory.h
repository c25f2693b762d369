// GPU memory of a renderer by use, in bytes. A plain value.
#pragma once

#include <cstddef>

namespace terrane::render {

struct GpuMemory {
    std::size_t quads = 0, light = 0;  // buffers and textures, including free room
    std::size_t meshSections = 0;      // records, their order, draw commands
    std::size_t textures = 0;          // of blocks and sky
    std::size_t targets = 0;           // G-buffer, shadow map, layers and so on
    std::size_t staging = 0;           // of the mesher on the GPU

    std::size_t world() const { return quads + light + meshSections; }  // grows with the view distance
    std::size_t fixed() const { return textures + targets + staging; }
    std::size_t total() const { return world() + fixed(); }
};

}  // namespace terrane::render
