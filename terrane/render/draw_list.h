// Chooses what to draw: regions in the frustum, without the groups of faces that look away from the camera,
// as indirect draw commands sorted by distance. Pure bookkeeping without OpenGL calls.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/render/camera.h"
#include "terrane/render/quad_store.h"
#include "terrane/shared/frame.h"

namespace terrane::render {

// As glMultiDrawElementsIndirect reads it.
struct DrawCommand {
    std::uint32_t indexCount = 0, instanceCount = 1, firstIndex = 0;
    std::int32_t baseVertex = 0;     // 4 × first quad
    std::uint32_t baseInstance = 0;  // number of the draw record
};

// Quads a command can draw: four vertices each within 16-bit indices.
constexpr std::uint32_t kMaxQuadsPerCommand = 16384;

struct DrawList {
    std::array<std::vector<DrawCommand>, mesh::kContextCount>
        commands;  // near to far; blended ones far to near
    std::vector<shared::DrawRecord> records;
    std::size_t quadCount = 0;
    std::size_t regionCount = 0;
};

void buildDrawList(DrawList& list, const QuadStore& quads, const Camera& camera, const ViewMatrices& view);

}  // namespace terrane::render
