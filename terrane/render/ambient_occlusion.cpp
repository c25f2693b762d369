#include "terrane/render/ambient_occlusion.h"

#include "terrane/shared/bindings.h"

namespace terrane::render {

AmbientOcclusion::AmbientOcclusion(const gpu::ShaderLoader& shaders)
    : find_(shaders, "ambient_occlusion"),
      alongX_(shaders, "occlusion_blur"),
      alongY_(shaders, "occlusion_blur") {}

base::Result<void> AmbientOcclusion::configure(const FrameTargets& targets, bool isOn) {
    if (isOn) {
        const std::string samples = std::to_string(targets.msaaSamples);
        auto selected = find_.select({{"MSAA_SAMPLES", samples}});
        if (selected) selected = alongX_.select({{"AXIS", "0"}, {"MSAA_SAMPLES", samples}});
        if (selected) selected = alongY_.select({{"AXIS", "1"}, {"MSAA_SAMPLES", samples}});
        if (!selected) return selected;
    }
    const glm::ivec2 wanted = isOn ? targets.size : glm::ivec2(0);
    if (wanted == size_) return {};
    visibility_ = {};
    between_ = {};
    size_ = {0, 0};
    if (!isOn) return {};
    auto visibility = ColorTarget::create(wanted, GL_R8, "ambient occlusion");
    if (!visibility) return tl::unexpected(visibility.error());
    auto between = ColorTarget::create(wanted, GL_R8, "occlusion between");
    if (!between) return tl::unexpected(between.error());
    visibility_ = std::move(*visibility);
    between_ = std::move(*between);
    size_ = wanted;
    return {};
}

void AmbientOcclusion::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    targets.bindGBuffer();
    visibility_.framebuffer.bind();
    find_.draw(pipeline, {});
    between_.framebuffer.bind();
    visibility_.texture.bind(shared::kOcclusionUnit);
    alongX_.draw(pipeline, {});
    visibility_.framebuffer.bind();
    between_.texture.bind(shared::kOcclusionUnit);
    alongY_.draw(pipeline, {});
}

}  // namespace terrane::render
