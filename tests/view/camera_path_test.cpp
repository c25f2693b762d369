#include "terrane/view/camera_path.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace terrane::view {
namespace {

CameraKey keyAt(double time, glm::dvec3 position, double yaw = 0) {
    return {.time = time, .position = position, .yaw = yaw, .lookAt = std::nullopt};
}

CameraKey keyToward(double time, glm::dvec3 position, glm::dvec3 point) {
    return {.time = time, .position = position, .lookAt = point};
}

TEST(CameraPath, HasEveryNumberOfAKey) {
    CameraKey a = keyAt(0, {1, 2, 3}, 10), b = keyAt(2, {5, 6, 7}, 20);
    a.pitch = -10;
    a.timeDay = 0.25;
    a.fieldOfView = 50;
    const CameraPath path({a, b});
    const PathPoint point = path.at(0);
    EXPECT_EQ(point.camera.position, glm::dvec3(1, 2, 3));
    EXPECT_FLOAT_EQ(point.camera.yaw, 10);
    EXPECT_FLOAT_EQ(point.camera.pitch, -10);
    EXPECT_FLOAT_EQ(point.camera.fieldOfView, 50);
    EXPECT_FLOAT_EQ(point.timeDay, 0.25f);
    EXPECT_EQ(path.at(1).camera.position, glm::dvec3(3, 4, 5));
    EXPECT_EQ(path.at(9).camera.position, glm::dvec3(5, 6, 7));
}

TEST(CameraPath, TurnsTheShorterWay) {
    const CameraPath path({keyAt(0, {}, 350), keyAt(1, {}, 10), keyAt(2, {}, 300)});
    EXPECT_FLOAT_EQ(path.at(0).camera.yaw, 350);
    EXPECT_FLOAT_EQ(path.at(1).camera.yaw, 370);
    EXPECT_FLOAT_EQ(path.at(2).camera.yaw, 300);
    for (double t = 0; t <= 1; t += 0.1) EXPECT_GE(path.at(t).camera.yaw, 350) << t;
}

TEST(CameraPath, KeepsAPointInView) {
    const glm::dvec3 point(0, 0, 60);
    const CameraPath path({keyToward(0, {100, 0, 90}, point), keyToward(2, {0, 100, 70}, point),
                           keyToward(5, {-100, 0, 80}, point)});
    for (double t = 0; t <= 5; t += 0.25) {
        const render::Camera camera = path.at(t).camera;
        const glm::dvec3 toPoint = glm::normalize(point - camera.position);
        EXPECT_NEAR(glm::dot(glm::dvec3(render::lookDirection(camera)), toPoint), 1, 1e-6) << t;
    }
}

TEST(CameraPath, DaysGoOn) {
    CameraKey a = keyAt(0, {}), b = keyAt(10, {});
    a.timeDay = 0.5;
    b.timeDay = 1.5;
    const CameraPath path({a, b});
    EXPECT_FLOAT_EQ(path.at(4).timeDay, 0.9f);
    EXPECT_NEAR(path.at(6).timeDay, 0.1f, 1e-6);
    EXPECT_FLOAT_EQ(path.at(10).timeDay, 0.5f);
}

TEST(CameraPath, LookFromOnePointToAnother) {
    EXPECT_NEAR(lookFrom({0, 0, 0}, {5, 0, 0}).yaw, 0, 1e-9);
    EXPECT_NEAR(lookFrom({0, 0, 0}, {0, 5, 0}).yaw, 90, 1e-9);
    EXPECT_NEAR(lookFrom({0, 0, 0}, {3, 0, 3}).pitch, 45, 1e-9);
    EXPECT_NEAR(lookFrom({0, 0, 9}, {0, 0, 3}).pitch, -90, 1e-9);
}

TEST(CameraPath, RefusesKeysThatMakeNone) {
    EXPECT_THROW(CameraPath({}), std::invalid_argument);
    EXPECT_THROW(CameraPath({keyAt(1, {}), keyAt(1, {})}), std::invalid_argument);
    EXPECT_THROW(CameraPath({keyAt(0, {}), keyToward(1, {}, {})}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::view
