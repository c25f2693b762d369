// The path tracer against scenes whose light is known.
#include "terrane/path/tracer.h"

#include "tests/path/path_world.h"

namespace terrane::path {
namespace {

// Within 3.5 standard deviations (once in 2,000 seeds it is not), which are small.
void expectNear(const Estimate& found, double expected, double share) {
    EXPECT_NEAR(found.mean, expected, 3.5 * found.error + 1e-5 * expected);
    EXPECT_LT(found.error, share * expected);
}

// Each path returns its share of what it took: 1 wherever one looks.
TEST(TracerTest, AWhiteWorldUnderAWhiteSkyIsWhite) {
    const Scene hills(
        pathParts([](int x, int y, int z) { return z < 10 + (x * 7 + y * 5) % 4 ? "white" : nullptr; },
                  evenSky(glm::vec3(1))));
    Camera wide;
    wide.position = {0.5, 0.5, 30.5};
    wide.ahead = {0, 0, -1};
    wide.across = {0.4f, 0, 0};
    wide.up = {0, 0.4f, 0};
    const Estimate open = estimate(hills, wide, 700'000, 1'000'000);
    EXPECT_NEAR(open.mean, 1, 1e-3);
    EXPECT_LT(open.error, 4e-4);
}

TEST(TracerTest, AWhitePitIsWhite) {
    const Scene pit(pathParts(
        [](int x, int y, int z) { return z < 10 && !(x == 0 && y == 0 && z > 6) ? "white" : nullptr; },
        evenSky(glm::vec3(1))));
    const Estimate deep = estimate(pit, lookDown({0.4, 0.3, 20}), 400'000, 1'000'000);
    EXPECT_NEAR(deep.mean, 1, 1e-3);
    EXPECT_LT(deep.error, 6e-4);
}

TEST(TracerTest, BouncesAreLeftOutBeyondTheLimit) {
    const Scene pit(pathParts(
        [](int x, int y, int z) { return z < 10 && !(x == 0 && y == 0 && z > 6) ? "white" : nullptr; },
        evenSky(glm::vec3(1))));
    EXPECT_LT(estimate(pit, lookDown({0.4, 0.3, 20}), 20'000, 2).mean, 0.9);
}

// A closed room of walls that emit E and reflect a share: E / (1 - share). A camera sees the texture in place
// of E at the first wall.
TEST(TracerTest, LightInAClosedRoomIsAGeometricSeries) {
    const Scene room(pathParts(
        [](int x, int y, int z) {
            return x >= 5 && x < 8 && y >= 5 && y < 7 && z >= 10 && z < 12 ? nullptr : "gray_lamp";
        },
        evenSky(glm::vec3(0)), 0));
    const double shown = grayAlbedo(), emitted = double{kLampRadiance};
    expectNear(estimate(room, lookDown({6.3, 5.8, 11.5}), 200'000),
               shown + grayAlbedo() * emitted / (1 - grayAlbedo()), 0.005);
}

double lampAlone(double distance) {
    const int height = 10 + static_cast<int>(distance);
    const Scene scene(pathParts(
        [=](int x, int y, int z) {
            if (x == 0 && y == 0 && z == height) return "lamp";
            return z < 10 ? "gray" : nullptr;
        },
        evenSky(glm::vec3(0))));
    EXPECT_EQ(scene.emitters.size(), 6u);
    const double expected = grayAlbedo() * double{kLampRadiance} * squareFactor(0.5, distance);
    expectNear(estimate(scene, lookDown({0.5, 0.5, 10.5}), 100'000), expected, 0.03);
    return expected;
}

TEST(TracerTest, ALampLightsThePlaneBelowAsASquareDoes) {
    lampAlone(2);
    lampAlone(6);
    // So far away that it is in none of the grid's cells around.
    lampAlone(45);
}

// It emits as much as one that glows all over, from a quarter of each face.
TEST(TracerTest, LightRaysGoToThePartOfAFaceThatGlows) {
    const Scene scene(pathParts(
        [](int x, int y, int z) {
            if (x == 0 && y == 0 && z == 16) return "quarter_lamp";
            return z < 10 ? "gray" : nullptr;
        },
        evenSky(glm::vec3(0))));
    const double expected = grayAlbedo() * double{kLampRadiance} * squareFactor(0.5, 6);
    const Estimate found = estimate(scene, lookDown({0.5, 0.5, 10.5}), 100'000);
    EXPECT_NEAR(found.mean, expected, 3.5 * found.error + 0.01 * expected);
    EXPECT_LT(found.error, 0.01 * expected);
}

TEST(TracerTest, SkyOverAPitLightsItsGroundAsASquareDoes) {
    for (const int depth : {1, 3}) {
        const Scene scene(pathParts(
            [=](int x, int y, int z) {
                if (z >= 10 || (x == 0 && y == 0 && z >= 10 - depth))
                    return static_cast<const char*>(nullptr);
                return x == 0 && y == 0 ? "gray" : "black";
            },
            evenSky(glm::vec3(1))));
        expectNear(estimate(scene, lookDown({0.5, 0.5, 20}), 300'000),
                   grayAlbedo() * squareFactor(0.5, depth), 0.01);
    }
}

// The scale of the rasterizer: open ground reflects its color times ambient light and sunlight.
TEST(TracerTest, OpenGroundIsAsBrightAsTheRasterizersIs) {
    for (const float time : {0.3f, 0.5f, 0.79f, 0.95f}) {
        const world::Environment e = world::environmentAt(time);
        shared::AirFrame air{};
        air.lightAzimuth.z = e.ambientColor.y;
        const Scene scene(
            pathParts([](int, int, int z) { return z < 10 ? "gray" : nullptr; }, skyOf(e, air)));
        const double expected =
            grayAlbedo() * double{e.ambientColor.y + e.lightColor.y * std::max(e.lightDirection.z, 0.0f)};
        const Estimate found = estimate(scene, lookDown({0.5, 0.5, 20}), 100'000);
        EXPECT_NEAR(found.mean, expected, 3.5 * found.error + 2e-3 * expected) << time;
        EXPECT_LT(found.error, 0.01 * expected) << time;
    }
}

// Water from straight above: a mirror, and a black floor below. Waves turn the mirror by a few degrees, which
// changes nothing under an even sky.
TEST(TracerTest, WaterMirrorsAShareOfTheSky) {
    Sky sky = evenSky(glm::vec3(1));
    const Scene scene(pathParts([](int, int, int z) { return z < 10   ? "black"
                                                             : z < 11 ? "water"
                                                                      : nullptr; },
                                std::move(sky)));
    const double fresnel = std::pow((1.333 - 1) / (1.333 + 1), 2);
    const Estimate found = estimate(scene, lookDown({0.5, 0.5, 20}), 200'000);
    // What the water scatters comes on top.
    EXPECT_GT(found.mean, fresnel);
    EXPECT_LT(found.mean, fresnel + 0.25);
}

TEST(TracerTest, CamerasInRockSeeNothing) {
    const Scene scene(
        pathParts([](int, int, int z) { return z < 10 ? "white" : nullptr; }, evenSky(glm::vec3(1))));
    EXPECT_EQ(estimate(scene, lookDown({0.5, 0.5, 5.5}), 100).mean, 0);
}

TEST(TracerTest, ALensBlursWhatIsOutOfFocus) {
    const Scene scene(
        pathParts([](int x, int, int z) { return z < 10 ? (x & 1) == 0 ? "white" : "black" : nullptr; },
                  evenSky(glm::vec3(1))));
    Camera camera = lookDown({0.5, 0.5, 20});
    camera.lensRadius = 1;
    camera.focus = 10;
    EXPECT_GT(estimate(scene, camera, 2'000).mean, 0.95) << "in focus";
    camera.focus = 3;
    const double blurred = estimate(scene, camera, 2'000).mean;
    EXPECT_LT(blurred, 0.8);
    EXPECT_GT(blurred, 0.2);
}

}  // namespace
}  // namespace terrane::path
