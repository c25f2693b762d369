// Hi-Z: the farthest depths of squares of pixels in a mip chain, for occlusion culling.
#include <bit>

#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"
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
glm::ivec2 usedSize(glm::ivec2 pixels) {
    constexpr int kPixels = shared::kHiZTexelPixels;
    return (pixels + kPixels - 1) / kPixels;
}

void dispatch(glm::ivec2 size) {
    constexpr int kGroup = shared::kHiZThreads;
    glDispatchCompute(static_cast<GLuint>((size.x + kGroup - 1) / kGroup),
                      static_cast<GLuint>((size.y + kGroup - 1) / kGroup), 1);
}

void clearToNear(const gpu::Texture2D& hiZ) {
    constexpr float kNear = 1;
    for (int level = 0; level < hiZ.levels(); ++level)
        glClearTexImage(hiZ.id(), level, GL_RED, GL_FLOAT, &kNear);
}

}  // namespace

MaybePass makeDepthPyramid(FrameBuilder& build) {
    if (!build.options().occlusionCulling) return std::nullopt;
    const auto* finest =
        TERRANE_TRY(build.programs.compute("cull/hi_z", HiZVariant{build.samples(), true}.defines()));
    const auto* next = TERRANE_TRY(build.programs.compute("cull/hi_z", HiZVariant{1, false}.defines()));
    const glm::ivec2 pixels = build.frame.spec.size, size = finestSize(pixels);
    const TargetRef hiZ = build.target({"Hi-Z", GL_R32F, size, 1, gpu::fullLevels(size)});
    const TargetRef depth = build.frame.targets.depth;
    build.frame.targets.hiZ = hiZ;
    clearToNear(hiZ->plain());  // also after an image of another size
    return Pass{
        .reads = {depth},
        .writes = {hiZ},
        .record =
            [=](FrameContext& context) {
                const GLuint id = hiZ->id();
                glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);  // the frame before may still read it
                glBindImageTexture(shared::kHiZToImage, id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
                gpu::TextureSet().add(shared::kDepthUnit, depth->id()).bind();
                finest->use();
                dispatch(usedSize(pixels));
                next->use();
                glm::ivec2 drawn = usedSize(pixels);
                // On the CPU the finest level is read back.
                const bool isFinestOnly = context.culling.method == DrawMethod::Loop;
                for (int level = 1; level < hiZ->plain().levels() && !isFinestOnly; ++level) {
                    drawn = (drawn + 1) / 2;
                    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
                    glBindImageTexture(shared::kHiZFromImage, id, level - 1, GL_FALSE, 0, GL_READ_ONLY,
                                       GL_R32F);
                    glBindImageTexture(shared::kHiZToImage, id, level, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
                    dispatch(drawn);
                }
                glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
            },
        .isNeeded = [](FrameContext& context) { return context.cullsOccluded(); },
        .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
