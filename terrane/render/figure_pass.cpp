#include "terrane/render/figure_pass.h"

#include <cassert>
#include <cstring>

#include "terrane/gpu/debug.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

FigurePass::FigurePass(const gpu::ShaderLoader& shaders)
    : surfaces_(shaders, "terrane/render/figure.vert.glsl", "terrane/render/figure.frag.glsl", "figures"),
      shadows_(shaders, "terrane/render/figure.vert.glsl", "terrane/render/figure_shadow.frag.glsl",
               "shadows of figures"),
      vertexArray_("figures") {}

base::Result<void> FigurePass::select(bool castsShadows) {
    auto selected = surfaces_.select(defined({{"PASS", 0}}));
    if (selected && castsShadows) selected = shadows_.select(defined({{"PASS", 2}}));
    return selected;
}

void FigurePass::bind(std::span<const shared::FigureRecord> figures, gpu::MappedRing& ring) const {
    assert(!figures.empty() && figures.size() <= shared::kMostFigures && "what figureRecords() gives");
    const auto slice = ring.allocate(kRingBytes);  // a block of uniforms is bound as a whole
    assert(slice && "the ring has room for the figures of a frame");
    std::memcpy(slice->data.data(), figures.data(), figures.size_bytes());
    ring.bindUniform(shared::kFiguresBinding, *slice);
}

void FigurePass::draw(gpu::Pipeline& pipeline, const FrameTargets& targets, std::size_t count) const {
    const gpu::DebugGroup group("figures");
    targets.gbuffer.bind();
    pipeline.set({.depthTest = gpu::DepthTest::Greater});
    surfaces_.use();
    drawInstances(count);
}

void FigurePass::drawShadows(std::size_t count) const {
    shadows_.use();
    drawInstances(count);
}

void FigurePass::drawInstances(std::size_t count) const {
    vertexArray_.bind();
    glDrawArraysInstanced(GL_TRIANGLES, 0, shared::kFigureBoxes * shared::kVerticesPerFigureBox,
                          static_cast<GLsizei>(count));
}

}  // namespace terrane::render
