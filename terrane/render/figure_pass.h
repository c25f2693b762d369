// Draws the figures of players into the G-buffer, all of them in one draw call. Used by the renderer on the
// context's thread.
#pragma once

#include <span>

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/frame_targets.h"
#include "terrane/render/shader_variants.h"
#include "terrane/shared/figure.h"

namespace terrane::render {

class FigurePass {
  public:
    // What bind() takes, whatever the number of figures.
    static constexpr std::size_t kRingBytes = shared::kMostFigures * sizeof(shared::FigureRecord);

    FigurePass() = default;
    explicit FigurePass(const gpu::ShaderLoader& shaders);

    base::Result<void> select(bool castsShadows);
    // For what is drawn next: one to kMostFigures figures. Takes kRingBytes of the ring.
    void bind(std::span<const shared::FigureRecord> figures, gpu::MappedRing& ring) const;
    // Adds `count` figures that are bound to the G-buffer, with the frame's uniforms bound.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets, std::size_t count) const;
    // To the depth that is bound, with the uniforms of a shadow map's rectangle bound too.
    void drawShadows(std::size_t count) const;

  private:
    void drawInstances(std::size_t count) const;

    ShaderVariants surfaces_, shadows_;
    gpu::VertexArray vertexArray_;
};

}  // namespace terrane::render
