// Draws the figures of players into the G-buffer, all of them in one draw call. The renderer uses it on the
// context's thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/frame/camera.h"
#include "terrane/shared/figure.h"
#include "terrane/world/pose.h"

namespace terrane::render {

// Records of the figures of a frame for shaders. A pure function; any thread may use it. Box of a figure
// around its feet, in blocks: legs and arms swing out of the box of the player, hair is above it.
constexpr glm::vec3 kFigureLow{-1, -1, -0.2f}, kFigureHigh{1, 1, 2.2f};

// Returns the figures inside the planes (in positions of the frame) that are nearer than `farBlocks` and not
// around the camera; the nearest kMostFigures of them.
std::vector<shared::FigureRecord> figureRecords(std::span<const world::Figure> figures, const Camera& camera,
                                                std::span<const glm::vec4> planes, double farBlocks);

class FigurePass {
  public:
    // Bytes that bind() takes of the ring, for any number of figures.
    static constexpr std::size_t kRingBytes = shared::kMostFigures * sizeof(shared::FigureRecord);

    FigurePass() : vertexArray_("figures") {}

    // Binds one to kMostFigures figures for the next draws. Takes kRingBytes of the ring.
    void bind(std::span<const shared::FigureRecord> figures, gpu::MappedRing& ring) const;
    // Draws `count` bound figures with figure.vert.glsl, into the bound framebuffer.
    void draw(const gpu::Program& program, std::size_t count) const;

  private:
    gpu::VertexArray vertexArray_;
};

}  // namespace terrane::render
