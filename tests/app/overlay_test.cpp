#include "apps/terrane/window/hud/overlay.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

TEST(DebugTopView, IsAsHighAboveTheCameraAtAllHeights) {
    const auto above = [](double z) {
        render::Camera camera;
        camera.position = {5, 6, z};
        return debugTopCamera(camera, 16).position.z - z;
    };
    EXPECT_GT(above(100), 100);
    for (const double z : {-2000.0, -700.0, 1500.0}) EXPECT_DOUBLE_EQ(above(z), above(100));
}

}  // namespace
}  // namespace terrane::app
