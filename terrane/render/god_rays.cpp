#include "terrane/render/god_rays.h"

#include "terrane/shared/bindings.h"

namespace terrane::render {

GodRays::GodRays(const gpu::ShaderLoader& shaders) : pass_(shaders, "god_rays"), smooth_({}, "smooth") {}

base::Result<void> GodRays::configure(glm::ivec2 size, bool isOn) {
    const glm::ivec2 wanted = isOn ? (size + 1) / 2 : glm::ivec2(0);
    if (wanted == size_) return {};
    rays_ = {};
    size_ = {0, 0};
    if (!isOn) return {};
    if (auto selected = pass_.select({}); !selected) return selected;
    auto rays = ColorTarget::create(wanted, GL_R8, "god rays");
    if (!rays) return tl::unexpected(rays.error());
    rays_ = std::move(*rays);
    size_ = wanted;
    return {};
}

void GodRays::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    rays_.framebuffer.bind();
    targets.sceneColor.bind(shared::kSceneUnit);
    smooth_.bind(shared::kSceneUnit);
    pass_.draw(pipeline, {});
}

void GodRays::bindResult() const {
    rays_.texture.bind(shared::kGodRaysUnit);
    smooth_.bind(shared::kGodRaysUnit);
}

}  // namespace terrane::render
