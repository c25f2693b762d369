#include "terrane/render/quads/gbuffer_pass.h"

#include "terrane/gpu/debug.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr gpu::PipelineState kNearest{.depthTest = gpu::DepthTest::Greater};

}  // namespace

GBufferPass::GBufferPass(const gpu::ShaderLoader& shaders)
    : opaque_(quadShaders(shaders, "quads/gbuffer", "opaque quads")),
      tested_(quadShaders(shaders, "quads/gbuffer", "tested quads")) {}

base::Result<void> GBufferPass::select(int alphaSamples, bool isSmooth, const QuadFeatures& features) {
    const auto variant = [&](int alphaClass, int samples) {
        return defined({{"PASS", 0},
                        {"ALPHA_CLASS", alphaClass},
                        {"MSAA_SAMPLES", samples},
                        {"SMOOTH", isSmooth},
                        {"FACE_SAMPLING", features.hasFaceSampling},
                        {"TINT", features.hasTint}});
    };
    TERRANE_TRY(opaque_.select(variant(0, 1)));
    return tested_.select(variant(1, alphaSamples));
}

void GBufferPass::clear(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    pipeline.set(kNearest);
    targets.gbuffer.clearColor(0, glm::vec4(1));
    targets.gbuffer.clearDepth(0.0f);
}

void GBufferPass::draw(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads) const {
    const gpu::DebugGroup group("G-buffer");
    targets.gbuffer.bind();
    quads.bind();
    opaque_.use();
    quads.draw(pipeline, kNearest, mesh::AlphaClass::Opaque);
    tested_.use();
    quads.draw(pipeline, kNearest, mesh::AlphaClass::Tested);
}

}  // namespace terrane::render
