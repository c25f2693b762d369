#include "terrane/render/effects/god_rays.h"

#include "terrane/shared/bindings.h"

namespace terrane::render {

GodRays::GodRays(const gpu::ShaderLoader& shaders)
    : sample_(shaders, "effects/god_rays"),
      smooth_(shaders, "effects/god_rays_smooth"),
      linear_({}, "smooth"),
      nearest_({.minFilter = GL_NEAREST, .magFilter = GL_NEAREST}, "nearest") {}

base::Result<void> GodRays::configure(glm::ivec2 size, bool isOn) {
    const glm::ivec2 wanted = isOn ? (size + 2) / 3 : glm::ivec2(0);
    if (wanted == size_) return {};
    sampled_ = {};
    smoothed_ = {};
    size_ = {0, 0};
    if (!isOn) return {};
    for (FullscreenPass* pass : {&sample_, &smooth_}) TERRANE_TRY(pass->select({}));
    for (ColorTarget* target : {&sampled_, &smoothed_}) {
        auto made = TERRANE_TRY(ColorTarget::create(wanted, GL_R8, "god rays"));
        *target = std::move(made);
    }
    size_ = wanted;
    return {};
}

void GodRays::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    nearest_.bind(shared::kSceneUnit);
    sampled_.framebuffer.bind();
    targets.sceneColor.bind(shared::kSceneUnit);
    sample_.draw(pipeline, {});
    linear_.bind(shared::kSceneUnit);
    smoothed_.framebuffer.bind();
    sampled_.texture.bind(shared::kSceneUnit);
    smooth_.draw(pipeline, {});
}

void GodRays::bindResult() const {
    smoothed_.texture.bind(shared::kGodRaysUnit);
    linear_.bind(shared::kGodRaysUnit);
}

}  // namespace terrane::render
