#include "terrane/render/shadow_volume.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "terrane/shared/hash.h"

namespace terrane::render {
namespace {

const Camera kCamera{{8, 8, 100}, 30, -10, 70};

float unit(unsigned a, unsigned b) {
    return static_cast<float>(shared::hash2(a, b, 3) >> 8) / 16777216.0f;
}

// From any point that is seen nearby, everything on the way to the light is in the volume.
TEST(ShadowVolume, HoldsWhatCanCastAShadow) {
    const ViewMatrices view = viewMatrices(kCamera, 16.0f / 9);
    const Frustum frustum = frustumOf(view.viewProjection);
    const glm::vec3 light = glm::normalize(glm::vec3(0.4f, -0.5f, 0.7f));
    const ShadowVolume volume = shadowVolume(view, light, kShadowReach);
    int seen = 0;
    for (unsigned k = 0; k < 4000; ++k) {
        const glm::vec3 random(unit(k, 0), unit(k, 1), unit(k, 2));
        const glm::vec3 point = view.cameraPosition + 2 * kShadowReach * (random - 0.5f);
        if (glm::distance(point, view.cameraPosition) > kShadowReach || !mayBeVisible(frustum, point, point))
            continue;
        ++seen;
        for (const float way : {0.0f, 3.0f, 200.0f}) {
            const glm::vec3 caster = point + way * light;
            EXPECT_TRUE(mayBeInVolume(volume, caster - 0.01f, caster + 0.01f));
        }
    }
    EXPECT_GT(seen, 100);
}

TEST(ShadowVolume, LeavesOutTheRest) {
    const ViewMatrices view = viewMatrices(kCamera, 16.0f / 9);
    const ShadowVolume volume = shadowVolume(view, {0, 0, 1}, kShadowReach);
    const auto isIn = [&](glm::vec3 at) { return mayBeInVolume(volume, at - 1.0f, at + 1.0f); };
    const glm::vec3 forward = lookDirection(kCamera), camera = view.cameraPosition;
    EXPECT_TRUE(isIn(camera + 30.0f * forward));
    EXPECT_TRUE(isIn(camera + glm::vec3(0, 0, 100))) << "above";
    EXPECT_FALSE(isIn(camera - glm::vec3(0, 0, 60))) << "below all that is seen";
    EXPECT_FALSE(isIn(camera - 40.0f * forward)) << "behind";
    EXPECT_FALSE(isIn(camera + 120.0f * forward)) << "too far";
}

glm::vec3 onMap(const ShadowFit& fit, glm::vec3 point) {
    return glm::vec3(fit.toMap * glm::vec4(point, 1));
}

TEST(ShadowFit, HoldsWhatIsSeenNearby) {
    const ViewMatrices view = viewMatrices(kCamera, 16.0f / 9);
    const Frustum frustum = frustumOf(view.viewProjection);
    const ShadowFit fit = fitShadowMap(kCamera, 16.0f / 9, {0.3f, 0.5f, 0.8f}, 2048);
    for (unsigned k = 0; k < 4000; ++k) {
        const glm::vec3 random(unit(k, 0), unit(k, 1), unit(k, 2));
        const glm::vec3 point = view.cameraPosition + 100.0f * (random - 0.5f);
        if (glm::distance(point, view.cameraPosition) > kShadowReach || !mayBeVisible(frustum, point, point))
            continue;
        const glm::vec3 at = onMap(fit, point);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(at[axis], 0);
            EXPECT_LE(at[axis], 1);
        }
    }
}

// A place of the world lies at the same point of a texel wherever the camera goes and looks: shadows do not
// crawl.
TEST(ShadowFit, TexelsStayWhereTheyAre) {
    constexpr int kTexels = 1024;
    const glm::dvec3 place(220.3, 211.7, 95.2);
    glm::vec2 first{-1};
    for (int step = 0; step < 50; ++step) {
        Camera camera = kCamera;
        camera.position += glm::dvec3(200 + 0.37 * step, 200 - 0.21 * step, 0.05 * step);
        camera.yaw += static_cast<float>(3 * step);
        const world::ChunkPos chunk = cameraChunk(camera);
        const glm::vec3 relative(place - glm::dvec3(16.0 * chunk.x, 16.0 * chunk.y, 0));
        const ShadowFit fit = fitShadowMap(camera, 1.5f, {0.3f, 0.5f, 0.8f}, kTexels);
        const glm::vec2 texel = glm::vec2(onMap(fit, relative)) * static_cast<float>(kTexels);
        const glm::vec2 part = texel - glm::floor(texel);
        if (step == 0) first = part;
        EXPECT_NEAR(part.x, first.x, 0.02f) << step;
        EXPECT_NEAR(part.y, first.y, 0.02f) << step;
    }
}

}  // namespace
}  // namespace terrane::render
