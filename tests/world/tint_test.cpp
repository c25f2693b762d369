#include "terrane/world/tint.h"

#include <gtest/gtest.h>

namespace terrane::world {
namespace {

glm::vec3 colorOf(PackedColor color) {
    return glm::vec3(color >> 16 & 255u, color >> 8 & 255u, color & 255u) / 255.0f;
}

void expectNear(glm::vec3 a, glm::vec3 b, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

TEST(Tint, NeutralBecomesTheTint) {
    for (const PackedColor tint : {packColor(200, 40, 130), packColor(60, 180, 50), kNeutralTint}) {
        expectNear(tinted(colorOf(kNeutralTint), tint), colorOf(tint), 1e-3f);
        expectNear(tinted(glm::vec3(1), tint), glm::vec3(1), 1e-6f);
        expectNear(tinted(glm::vec3(0), tint), glm::vec3(0), 0.01f);
    }
    expectNear(tinted({0.3f, 0.6f, 0.9f}, kNeutralTint), {0.3f, 0.6f, 0.9f}, 1e-6f);
    EXPECT_GE(tinted(glm::vec3(0.5f), 0).r, 0.0f) << "a black tint is a number";
}

}  // namespace
}  // namespace terrane::world
