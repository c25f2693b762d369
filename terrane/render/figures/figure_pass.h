// Draws the figures of players into the G-buffer, all of them in one draw call. Used by the renderer on the
// context's thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/frame/camera.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/shader_variants.h"
#include "terrane/shared/figure.h"
#include "terrane/world/pose.h"

namespace terrane::render {

// Records of the figures of a frame for shaders. A pure function; any thread.
// Box of a figure around its feet, in blocks: legs and arms swing out of the box of the player, hair is above
// it.
constexpr glm::vec3 kFigureLow{-1, -1, -0.2f}, kFigureHigh{1, 1, 2.2f};

// Returns the figures inside the planes (in positions of the frame) that are nearer than `farBlocks` and not
// around the camera; the nearest kMostFigures of them.
std::vector<shared::FigureRecord> figureRecords(std::span<const world::Figure> figures, const Camera& camera,
                                                std::span<const glm::vec4> planes, double farBlocks);

class FigurePass {
  public:
    // Bytes that bind() takes of the ring, for any number of figures.
    static constexpr std::size_t kRingBytes = shared::kMostFigures * sizeof(shared::FigureRecord);

    FigurePass() = default;
    explicit FigurePass(const gpu::ShaderLoader& shaders);

    base::Result<void> select(bool castsShadows);
    // Binds one to kMostFigures figures for the next draws. Takes kRingBytes of the ring.
    void bind(std::span<const shared::FigureRecord> figures, gpu::MappedRing& ring) const;
    // Draws `count` bound figures into the G-buffer, with the frame's uniforms bound.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets, std::size_t count) const;
    // Draws into the bound depth, with the uniforms of a shadow map's rectangle bound too.
    void drawShadows(std::size_t count) const;

  private:
    void drawInstances(std::size_t count) const;

    ShaderVariants surfaces_, shadows_;
    gpu::VertexArray vertexArray_;
};

}  // namespace terrane::render
