#include "terrane/render/cull/hi_z.h"

#include <bit>

#include "terrane/gpu/debug.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {
namespace {

// Sizes are powers of two, so that texel n of a level covers texels 2 n and 2 n + 1 of the finer one.
glm::ivec2 finestSize(glm::ivec2 pixels) {
    const auto side = [](int n) {
        const auto texels =
            (static_cast<unsigned>(n) + shared::kHiZTexelPixels - 1) / shared::kHiZTexelPixels;
        return static_cast<int>(std::bit_ceil(texels));
    };
    return {side(pixels.x), side(pixels.y)};
}

// Texels of the finest level that cover the image. The others keep their near depth.
glm::ivec2 used(glm::ivec2 pixels) {
    constexpr int kPixels = shared::kHiZTexelPixels;
    return (pixels + kPixels - 1) / kPixels;
}

void dispatch(glm::ivec2 size) {
    constexpr int kGroup = shared::kHiZThreads;
    glDispatchCompute(static_cast<GLuint>((size.x + kGroup - 1) / kGroup),
                      static_cast<GLuint>((size.y + kGroup - 1) / kGroup), 1);
}

}  // namespace

base::Result<void> HiZ::configure(const FrameTargets& targets, bool isOn) {
    if (!isOn) {
        texture_ = {};
        return {};
    }
    const char* name = "terrane/render/cull/hi_z.comp.glsl";
    if (samples_ != targets.msaaSamples) {
        auto finest = TERRANE_TRY(gpu::Program::compute(
            *shaders_, name, {{"LEVEL_0", "1"}, {"MSAA_SAMPLES", std::to_string(targets.msaaSamples)}},
            "Hi-Z"));
        auto next = TERRANE_TRY(
            gpu::Program::compute(*shaders_, name, {{"LEVEL_0", "0"}, {"MSAA_SAMPLES", "1"}}, "Hi-Z"));
        finest_ = std::move(finest);
        next_ = std::move(next);
        samples_ = targets.msaaSamples;
    }
    const glm::ivec2 size = finestSize(targets.size);
    // Texels of an image of another size must be cleared to the near depth.
    if (texture_.id() == 0 || imageSize_ != targets.size) {
        imageSize_ = targets.size;
        texture_ = gpu::Texture2D(size, GL_R32F, gpu::fullLevels(size), "Hi-Z");
        constexpr float kNear = 1;
        for (int level = 0; level < levels(); ++level)
            glClearTexImage(texture_.id(), level, GL_RED, GL_FLOAT, &kNear);
    }
    return {};
}

void HiZ::build(const FrameTargets& targets) const {
    const gpu::DebugGroup group("Hi-Z");
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);  // the frame before may still read it
    glBindImageTexture(shared::kHiZToImage, texture_.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    targets.depth.bind(shared::kDepthUnit);
    finest_.use();
    dispatch(used(targets.size));
    next_.use();
    glm::ivec2 drawn = used(targets.size);
    for (int level = 1; level < levels(); ++level) {
        drawn = (drawn + 1) / 2;
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        glBindImageTexture(shared::kHiZFromImage, texture_.id(), level - 1, GL_FALSE, 0, GL_READ_ONLY,
                           GL_R32F);
        glBindImageTexture(shared::kHiZToImage, texture_.id(), level, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
        dispatch(drawn);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace terrane::render
