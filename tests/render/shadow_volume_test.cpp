#include "terrane/render/shadow/shadow_volume.h"

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

}  // namespace
}  // namespace terrane::render
