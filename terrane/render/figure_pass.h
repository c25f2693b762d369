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
