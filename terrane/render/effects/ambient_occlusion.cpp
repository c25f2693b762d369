#include "terrane/render/effects/ambient_occlusion.h"

#include "terrane/shared/bindings.h"

namespace terrane::render {

AmbientOcclusion::Passes AmbientOcclusion::makePasses(const gpu::ShaderLoader& shaders) {
    return {FullscreenPass(shaders, "effects/ambient_occlusion"), FullscreenPass(shaders, "effects/occlusion_blur"),
            FullscreenPass(shaders, "effects/occlusion_blur")};
}

AmbientOcclusion::AmbientOcclusion(const gpu::ShaderLoader& shaders)
    : opaque_(makePasses(shaders)), nearestLayer_(makePasses(shaders)) {}

base::Result<void> AmbientOcclusion::select(Passes& passes, int samples, bool nearestLayer) {
    const auto variant = [&](int axis) {
        return defined({{"AXIS", axis}, {"MSAA_SAMPLES", samples}, {"NEAREST_LAYER", nearestLayer}});
    };
    auto selected = passes.find.select(defined({{"MSAA_SAMPLES", samples}, {"NEAREST_LAYER", nearestLayer}}));
    if (selected) selected = passes.alongX.select(variant(0));
    if (selected) selected = passes.alongY.select(variant(1));
    return selected;
}

base::Result<void> AmbientOcclusion::configure(const FrameTargets& targets, bool isOn, bool hasLayers) {
    if (isOn) {
        auto selected = select(opaque_, targets.msaaSamples, false);
        if (selected && hasLayers) selected = select(nearestLayer_, targets.msaaSamples, true);
        if (!selected) return selected;
    }
    const glm::ivec2 wanted = isOn ? targets.size : glm::ivec2(0);
    if (wanted == size_) return {};
    visibility_ = {};
    between_ = {};
    size_ = {0, 0};
    if (!isOn) return {};
    auto visibility = TERRANE_TRY(ColorTarget::create(wanted, GL_R8, "ambient occlusion"));
    auto between = TERRANE_TRY(ColorTarget::create(wanted, GL_R8, "occlusion between"));
    visibility_ = std::move(visibility);
    between_ = std::move(between);
    size_ = wanted;
    return {};
}

void AmbientOcclusion::run(gpu::Pipeline& pipeline, const FrameTargets& targets, const Passes& passes) const {
    targets.bindGBuffer();
    visibility_.framebuffer.bind();
    passes.find.draw(pipeline, {});
    between_.framebuffer.bind();
    visibility_.texture.bind(shared::kOcclusionUnit);
    passes.alongX.draw(pipeline, {});
    visibility_.framebuffer.bind();
    between_.texture.bind(shared::kOcclusionUnit);
    passes.alongY.draw(pipeline, {});
}

void AmbientOcclusion::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    run(pipeline, targets, opaque_);
}

void AmbientOcclusion::drawNearestLayer(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    run(pipeline, targets, nearestLayer_);
}

}  // namespace terrane::render
