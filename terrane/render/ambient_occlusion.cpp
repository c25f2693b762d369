#include "terrane/render/ambient_occlusion.h"

#include "terrane/shared/bindings.h"

namespace terrane::render {

AmbientOcclusion::AmbientOcclusion(const gpu::ShaderLoader& shaders)
    : find_(shaders, "ambient_occlusion"),
      alongX_(shaders, "occlusion_blur"),
      alongY_(shaders, "occlusion_blur") {}

base::Result<void> AmbientOcclusion::configure(const FrameTargets& targets, bool isOn) {
    if (isOn) {
        const std::string samples = std::to_string(targets.samples);
        auto selected = find_.select({{"SAMPLES", samples}});
        if (selected) selected = alongX_.select({{"AXIS", "0"}, {"SAMPLES", samples}});
        if (selected) selected = alongY_.select({{"AXIS", "1"}, {"SAMPLES", samples}});
        if (!selected) return selected;
    }
    const glm::ivec2 wanted = isOn ? targets.size : glm::ivec2(0);
    if (wanted == size_) return {};
    open_ = {};
    between_ = {};
    size_ = {0, 0};
    if (!isOn) return {};
    auto open = ColorTarget::create(wanted, GL_R8, "ambient occlusion");
    if (!open) return tl::unexpected(open.error());
    auto between = ColorTarget::create(wanted, GL_R8, "occlusion between");
    if (!between) return tl::unexpected(between.error());
    open_ = std::move(*open);
    between_ = std::move(*between);
    size_ = wanted;
    return {};
}

void AmbientOcclusion::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    targets.bindSurfaces();
    open_.framebuffer.bind();
    find_.draw(pipeline, {});
    between_.framebuffer.bind();
    open_.texture.bind(shared::kOcclusionUnit);
    alongX_.draw(pipeline, {});
    open_.framebuffer.bind();
    between_.texture.bind(shared::kOcclusionUnit);
    alongY_.draw(pipeline, {});
}

}  // namespace terrane::render
