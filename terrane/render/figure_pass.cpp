#include "terrane/render/figure_pass.h"

#include <cassert>
#include <cstring>

#include "terrane/gpu/debug.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

FigurePass::FigurePass(const gpu::ShaderLoader& shaders)
    : shaders_(shaders, "terrane/render/figure.vert.glsl", "terrane/render/figure.frag.glsl", "figures"),
      vertexArray_("figures") {}

void FigurePass::draw(gpu::Pipeline& pipeline, const FrameTargets& targets,
                      std::span<const shared::FigureRecord> figures, gpu::MappedRing& ring) const {
    assert(!figures.empty() && figures.size() <= shared::kMostFigures && "what figureRecords() gives");
    const gpu::DebugGroup group("figures");
    const auto slice = ring.allocate(kRingBytes);  // a block of uniforms is bound as a whole
    assert(slice && "the ring has room for the figures of a frame");
    std::memcpy(slice->data.data(), figures.data(), figures.size_bytes());
    ring.bindUniform(shared::kFiguresBinding, *slice);
    targets.gbuffer.bind();
    pipeline.set({.depthTest = gpu::DepthTest::Greater});
    shaders_.use();
    vertexArray_.bind();
    glDrawArraysInstanced(GL_TRIANGLES, 0, shared::kFigureBoxes * shared::kVerticesPerFigureBox,
                          static_cast<GLsizei>(figures.size()));
}

}  // namespace terrane::render
