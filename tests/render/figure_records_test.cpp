#include "terrane/render/figures/figure_pass.h"

#include <gtest/gtest.h>

#include "terrane/world/character.h"

namespace terrane::render {
namespace {

world::Figure standingAt(const glm::dvec3& feet, std::uint32_t look = 0) {
    return {.eyes = feet + glm::dvec3(0, 0, world::kEyeHeight), .look = look};
}

std::vector<shared::FigureRecord> recordsSeen(const std::vector<world::Figure>& figures, const Camera& camera,
                                              double farBlocks = 256) {
    const Frustum planes = frustumOf(viewMatrices(camera, 1.5f).viewProjection);
    return figureRecords(figures, camera, planes, farBlocks);
}

TEST(FigureRecords, PlacesCountFromTheCamerasChunk) {
    for (const double corner : {0.0, 1073741824.0, -1073741824.0}) {
        const Camera camera{.position = {corner + 3, corner + 5, 100}, .yaw = 0};
        world::Figure figure = standingAt({corner + 12.25, corner + 6.5, 99.125});
        figure.yaw = 90;
        figure.pitch = -45;
        figure.bodyYaw = 180;
        figure.look = 9;
        const auto records = recordsSeen({figure}, camera);
        ASSERT_EQ(records.size(), 1u);
        EXPECT_NEAR(records[0].feet.x, 12.25f, 1e-5f);
        EXPECT_NEAR(records[0].feet.y, 6.5f, 1e-5f);
        EXPECT_NEAR(records[0].feet.z, 99.125f, 1e-5f);
        EXPECT_NEAR(records[0].feet.w, 3.14159f, 1e-4f);
        EXPECT_NEAR(records[0].pose.x, 1.5708f, 1e-4f);
        EXPECT_NEAR(records[0].pose.y, -0.7854f, 1e-4f);
        EXPECT_EQ(records[0].look, 9u);
    }
}

TEST(FigureRecords, LeaveOutWhatIsNotInView) {
    const Camera camera{.position = {0, 0, 100}, .yaw = 0};
    EXPECT_EQ(recordsSeen({standingAt({10, 0, 99})}, camera).size(), 1u);
    EXPECT_EQ(recordsSeen({standingAt({-10, 0, 99})}, camera).size(), 0u) << "behind";
    EXPECT_EQ(recordsSeen({standingAt({10, 30, 99})}, camera).size(), 0u) << "beside";
    EXPECT_EQ(recordsSeen({standingAt({300, 0, 99})}, camera).size(), 0u) << "in the fog";
    EXPECT_EQ(recordsSeen({}, camera).size(), 0u);
}

TEST(FigureRecords, LeaveOutWhoStandsWhereTheCameraIs) {
    const Camera camera{.position = {0, 0, 99 + world::kEyeHeight}, .yaw = 0};
    EXPECT_EQ(recordsSeen({standingAt({0.1, 0.1, 99})}, camera).size(), 0u);
    EXPECT_EQ(recordsSeen({standingAt({0.1, 0.1, 98.8})}, camera).size(), 0u) << "a little lower";
    EXPECT_EQ(recordsSeen({standingAt({0.1, 0.1, 100})}, camera).size(), 0u) << "a step higher";
    EXPECT_EQ(recordsSeen({standingAt({0.6, 0, 99})}, camera).size(), 1u) << "face to face";
    const Camera down{.position = camera.position, .yaw = 0, .pitch = -80};
    EXPECT_EQ(recordsSeen({standingAt({0.1, 0, 97})}, down).size(), 1u) << "underneath";
}

TEST(FigureRecords, KeepsTheNearest) {
    std::vector<world::Figure> figures;
    for (std::uint32_t k = 0; k < shared::kMostFigures + 50; ++k)
        figures.push_back(standingAt({200 - 0.5 * k, 0, 99}, k));
    const auto records = recordsSeen(figures, {.position = {0, 0, 100}, .yaw = 0});
    ASSERT_EQ(records.size(), std::size_t{shared::kMostFigures});
    EXPECT_EQ(records.front().look, shared::kMostFigures + 49) << "the nearest is first";
    EXPECT_EQ(records.back().look, 50u);
}

}  // namespace
}  // namespace terrane::render
