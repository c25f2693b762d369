#include "terrane/render/effects/depth_of_field.h"

#include "terrane/shared/bindings.h"

namespace terrane::render {

DepthOfField::DepthOfField(const gpu::ShaderLoader& shaders)
    : alongX_(shaders, "effects/depth_of_field"), alongY_(shaders, "effects/depth_of_field"), smooth_({}, "smooth") {}

base::Result<void> DepthOfField::configure(const FrameTargets& targets, bool isOn) {
    if (isOn) {
        auto selected =
            alongX_.select({{"AXIS", "0"}, {"MSAA_SAMPLES", std::to_string(targets.msaaSamples)}});
        if (selected) selected = alongY_.select({{"AXIS", "1"}, {"MSAA_SAMPLES", "1"}});
        if (!selected) return selected;
    }
    const glm::ivec2 wanted = isOn ? (targets.size + 1) / 2 : glm::ivec2(0);
    if (wanted == size_) return {};
    between_ = {};
    result_ = {};
    size_ = {0, 0};
    if (!isOn) return {};
    auto between = TERRANE_TRY(ColorTarget::create(wanted, GL_RGBA16F, "blurred along x"));
    auto result = TERRANE_TRY(ColorTarget::create(wanted, GL_RGBA16F, "blurred"));
    between_ = std::move(between);
    result_ = std::move(result);
    size_ = wanted;
    return {};
}

void DepthOfField::draw(gpu::Pipeline& pipeline, const FrameTargets& targets,
                        const MsaaTexture& depth) const {
    depth.bind(shared::kDepthUnit);
    targets.sceneColor.bind(shared::kSceneUnit);
    between_.framebuffer.bind();
    alongX_.draw(pipeline, {});
    between_.texture.bind(shared::kDepthOfFieldUnit);
    smooth_.bind(shared::kDepthOfFieldUnit);
    result_.framebuffer.bind();
    alongY_.draw(pipeline, {});
}

void DepthOfField::bindResult() const {
    result_.texture.bind(shared::kDepthOfFieldUnit);
    smooth_.bind(shared::kDepthOfFieldUnit);
}

}  // namespace terrane::render
