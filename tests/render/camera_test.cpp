#include "terrane/render/frame/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

namespace terrane::render {
namespace {

constexpr float kNear = 0.05f;  // blocks, as camera.cpp has it

glm::vec4 clipPoint(const ViewMatrices& view, glm::vec3 point) {
    return view.viewProjection * glm::vec4(point, 1.0f);
}
glm::vec3 screenPoint(const ViewMatrices& view, glm::vec3 point) {
    const glm::vec4 clip = clipPoint(view, point);
    return glm::vec3(clip) / clip.w;
}

void expectNear(glm::vec3 a, glm::vec3 b, float tolerance = 1e-4f) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Camera, DirectionsFollowYawAndPitch) {
    expectNear(lookDirection({.yaw = 0}), {1, 0, 0});
    expectNear(lookDirection({.yaw = 90}), {0, 1, 0});
    expectNear(lookDirection({.yaw = 180}), {-1, 0, 0});
    expectNear(lookDirection({.pitch = 90}), {0, 0, 1});
    expectNear(lookDirection({.yaw = 90, .pitch = -45}), {0, std::sqrt(0.5f), -std::sqrt(0.5f)});
    expectNear(rightDirection({.yaw = 0}), {0, -1, 0});
    expectNear(rightDirection({.yaw = 90, .pitch = 60}), {1, 0, 0});
}

TEST(Camera, ChunkOfThePositionIsFloored) {
    EXPECT_EQ(cameraChunk({.position = {15.9, 16.0, 0}}), (world::ChunkPos{0, 1}));
    EXPECT_EQ(cameraChunk({.position = {-0.1, -16.1, 0}}), (world::ChunkPos{-1, -2}));
    EXPECT_EQ(cameraChunk({.position = {2147483647.5, -2147483648.0, 0}}),
              (world::ChunkPos{world::kMaxChunk, world::kMinChunk}));
}

TEST(Camera, PositionCountsFromTheCornerOfItsChunk) {
    expectNear(viewMatrices({.position = {35.25, -3.5, 99}}, 1).cameraPosition, {3.25f, 12.5f, 99});
    expectNear(viewMatrices({.position = {2147483647.5, -2147483647.25, 1}}, 1).cameraPosition,
               {15.5f, 0.75f, 1}, 1e-6f);
}

TEST(Camera, PointsProjectWhereTheyAreSeen) {
    const ViewMatrices view = viewMatrices({.position = {8, 8, 100}, .fieldOfView = 70}, 2.0f);
    const float top = 10 * std::tan(glm::radians(35.0f));  // of the image, 10 blocks ahead
    expectNear(screenPoint(view, {18, 8, 100}), {0, 0, kNear / 10});
    expectNear(screenPoint(view, {18, 8, 100 + top}), {0, 1, kNear / 10});
    expectNear(screenPoint(view, {18, 8, 100 - top}), {0, -1, kNear / 10});
    // Looking along +x, +y is on the left; the image is twice as wide as high.
    expectNear(screenPoint(view, {18, 8 + 2 * top, 100}), {-1, 0, kNear / 10});
    expectNear(screenPoint(view, {18, 8 - 2 * top, 100}), {1, 0, kNear / 10});
    EXPECT_LT(clipPoint(view, {-2, 8, 100}).w, 0) << "behind the camera";
}

TEST(Camera, TurnedCamerasProjectWhereTheyLook) {
    const ViewMatrices alongY = viewMatrices({.position = {8, 8, 100}, .yaw = 90}, 1);
    expectNear(screenPoint(alongY, {8, 18, 100}), {0, 0, kNear / 10});
    EXPECT_GT(screenPoint(alongY, {9, 18, 100}).x, 0) << "+x is on the right";
    const ViewMatrices down = viewMatrices({.position = {8, 8, 100}, .yaw = 0, .pitch = -90}, 1);
    expectNear(screenPoint(down, {8, 8, 90}), {0, 0, kNear / 10});
    EXPECT_GT(screenPoint(down, {9, 8, 90}).y, 0) << "what would be ahead is at the top";
    EXPECT_GT(screenPoint(down, {8, 7, 90}).x, 0);
}

TEST(Camera, DepthIsReversedWithoutFarPlane) {
    const ViewMatrices view = viewMatrices({.position = {0, 0, 100}}, 1);
    EXPECT_NEAR(screenPoint(view, {kNear, 0, 100}).z, 1, 1e-5f);
    EXPECT_GT(screenPoint(view, {10, 0, 100}).z, screenPoint(view, {11, 0, 100}).z);
    EXPECT_GT(screenPoint(view, {1e6f, 0, 100}).z, 0);
    // Two blocks apart a kilometre away still differ: floats are densest near 0.
    EXPECT_NE(screenPoint(view, {1000, 0, 100}).z, screenPoint(view, {1000.01f, 0, 100}).z);
}

TEST(Frustum, HoldsWhatIsAheadOnly) {
    const ViewMatrices view = viewMatrices({.position = {8, 8, 100}}, 1);
    const Frustum frustum = frustumOf(view.viewProjection);
    const auto unitBoxAt = [&](glm::vec3 corner) { return mayBeVisible(frustum, corner, corner + 1.0f); };
    EXPECT_TRUE(unitBoxAt({20, 8, 100}));
    EXPECT_TRUE(unitBoxAt({5000, 8, 100})) << "there is no far plane";
    EXPECT_TRUE(unitBoxAt({7.5f, 7.5f, 99.5f})) << "the camera is inside";
    EXPECT_FALSE(unitBoxAt({2, 8, 100})) << "behind";
    EXPECT_FALSE(unitBoxAt({18, 30, 100})) << "left";
    EXPECT_FALSE(unitBoxAt({18, -30, 100})) << "right";
    EXPECT_FALSE(unitBoxAt({18, 8, 120})) << "above";
    EXPECT_FALSE(unitBoxAt({18, 8, 80})) << "below";
    EXPECT_TRUE(mayBeVisible(frustum, {-500, -500, 0}, {500, 500, 256})) << "around everything";
    EXPECT_FALSE(mayBeVisible(frustum, {-60, -500, 0}, {8.03f, 500, 256})) << "a wall up to the near plane";
}

Camera randomCamera(std::mt19937& random) {
    const auto between = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    return {.position = {between(-100, 100), between(-100, 100), between(-20, 300)},
            .yaw = between(-180, 180),
            .pitch = between(-90, 90),
            .fieldOfView = between(20, 110)};
}

// Clearly inside, so that rounding decides nothing.
bool isSeen(glm::vec4 clip) {
    const float w = clip.w * 0.999f;
    return clip.w > kNear && std::abs(clip.x) <= w && std::abs(clip.y) <= w && clip.z <= w;
}

bool hasSeenCorner(const ViewMatrices& view, glm::vec3 min, glm::vec3 max) {
    for (int k = 0; k < 8; ++k) {
        const glm::vec3 corner(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
        if (isSeen(clipPoint(view, corner))) return true;
    }
    return false;
}

TEST(Frustum, NeverRejectsABoxWithASeenCorner) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-200, 200), size(0.1f, 80);
    int seen = 0, rejected = 0;
    for (int round = 0; round < 20000; ++round) {
        const ViewMatrices view = viewMatrices(randomCamera(random), 1.777f);
        const glm::vec3 min(place(random), place(random), place(random));
        const glm::vec3 max = min + glm::vec3(size(random), size(random), size(random));
        const bool kept = mayBeVisible(frustumOf(view.viewProjection), min, max);
        const bool hasCorner = hasSeenCorner(view, min, max);
        ASSERT_TRUE(kept || !hasCorner) << "round " << round;
        seen += hasCorner;
        rejected += !kept;
    }
    EXPECT_GT(seen, 2000) << "the test says something";
    EXPECT_GT(rejected, 8000) << "most of what is not seen is rejected";
}

// A test of corners alone misses boxes that the whole view passes through.
TEST(Frustum, NeverRejectsABoxAroundASeenPoint) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> side(-0.95f, 0.95f), depth(1, 400), size(0.1f, 200);
    for (int round = 0; round < 5000; ++round) {
        const Camera camera = randomCamera(random);
        const ViewMatrices view = viewMatrices(camera, 1.0f);
        const float distance = depth(random),
                    reach = std::tan(glm::radians(camera.fieldOfView / 2)) * distance;
        const glm::vec3 right = rightDirection(camera), look = lookDirection(camera);
        const glm::vec3 point = view.cameraPosition + look * distance + right * (reach * side(random)) +
                                glm::cross(right, look) * (reach * side(random));
        const glm::vec3 min = point - glm::vec3(size(random), size(random), size(random));
        const glm::vec3 max = point + glm::vec3(size(random), size(random), size(random));
        ASSERT_TRUE(mayBeVisible(frustumOf(view.viewProjection), min, max)) << "round " << round;
    }
}

}  // namespace
}  // namespace terrane::render
