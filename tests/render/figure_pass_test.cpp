// Figures of players in images: where they are, what hides them, what they cost.
#include "terrane/render/figures/figure_pass.h"

#include <algorithm>

#include "terrane/world/character.h"
#include "terrane/world/pose.h"
#include "tests/render/sunlit_fixture.h"

namespace terrane::render {
namespace {

constexpr double kFeet = 100;  // height

world::Figure figureOn(const glm::dvec3& feet, float yaw = 0) {
    return {.eyes = feet + glm::dvec3(0, 0, world::kEyeHeight), .yaw = yaw, .bodyYaw = yaw, .look = 3};
}

// Pixels that differ, as a box; empty where min is above max.
struct PixelBox {
    glm::ivec2 min{1 << 20}, max{-1};

    bool isEmpty() const { return max.x < 0; }
};

PixelBox boxOfDifference(const base::Image& a, const base::Image& b) {
    PixelBox box;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            if (pixel(a, x, y) == pixel(b, x, y)) continue;
            box.min = glm::min(box.min, glm::ivec2(x, y));
            box.max = glm::max(box.max, glm::ivec2(x, y));
        }
    }
    return box;
}

class FigurePassTest : public SunlitTest {
  protected:
    base::Image drawWith(const Camera& camera, std::span<const world::Figure> figures,
                         View view = View::Color) {
        FrameInput input = noon(camera, view);
        input.figures = figures;
        return draw(input);
    }
    PixelBox boxOf(const Camera& camera, const world::Figure& figure) {
        return boxOfDifference(drawWith(camera, {}), drawWith(camera, std::span(&figure, 1)));
    }
    bool isFigurePassTimed(std::span<const world::Figure> figures) {
        for (int frame = 0; frame < 4; ++frame) {
            drawWith({.position = {0, 8, kFeet + 1}, .yaw = 0}, figures);
            glFinish();
        }
        return std::ranges::any_of(renderer_->passTimes(), [](const auto& p) { return p.name == "figures"; });
    }
};

TEST_F(FigurePassTest, IsHiddenByAWall) {
    const StoneBox wall{{{6, 4, 98}, {6, 12, 104}}};
    show(stoneWorld({0, 0}, {0, 0}, std::span(&wall, 1)));
    const Camera camera{.position = {1, 8, kFeet + 1.5}, .yaw = 0};
    EXPECT_TRUE(boxOf(camera, figureOn({8, 8, kFeet})).isEmpty()) << "behind the wall";
    EXPECT_FALSE(boxOf(camera, figureOn({5, 8, kFeet})).isEmpty()) << "before it";
}

// A camera as high as the ground sees all that is higher above the middle of the image, whatever the
// distance.
TEST_F(FigurePassTest, FeetTouchTheGroundInEveryStep) {
    resize({160, 160}, 1);
    const Camera camera{.position = {2, 8, kFeet}, .yaw = 0};
    const int middle = 80;
    for (const float size : {0.0f, 0.3f, 0.7f, 1.0f}) {
        for (int k = 0; k < 8; ++k) {
            world::Figure figure = figureOn({4.2, 8, kFeet}, 90);
            figure.stride = 0.785f * static_cast<float>(k);
            figure.strideSize = size;
            const PixelBox box = boxOf(camera, figure);
            EXPECT_LE(box.max.y, middle) << "sinks, size " << size << ", phase " << figure.stride;
            EXPECT_GE(box.max.y, middle - 2) << "hovers, size " << size << ", phase " << figure.stride;
        }
    }
}

TEST_F(FigurePassTest, FitsThePlayersBox) {
    resize({160, 160}, 1);
    const glm::dvec3 feet(4, 8, kFeet);
    const PixelBox top =
        boxOf({.position = {2, 8, kFeet + world::kCharacterHeight}, .yaw = 0}, figureOn(feet));
    EXPECT_GE(top.min.y, 79) << "higher";
    EXPECT_LE(top.min.y, 82) << "lower";
    for (const float yaw : {0.0f, 20.0f, 45.0f, 90.0f, 250.0f}) {
        // In the plane of each side, which is the middle of the image.
        const double half = world::kCharacterWidth / 2;
        const PixelBox left = boxOf({.position = {2, 8 + half, kFeet + 1}, .yaw = 0}, figureOn(feet, yaw));
        EXPECT_GE(left.min.x, 79) << yaw;
        const PixelBox right = boxOf({.position = {2, 8 - half, kFeet + 1}, .yaw = 0}, figureOn(feet, yaw));
        EXPECT_LE(right.max.x, 80) << yaw;
    }
}

TEST_F(FigurePassTest, IsExactFarFromTheMiddleOfTheWorld) {
    const auto imageAt = [&](double corner) {
        const world::Figure figure = figureOn({corner + 4.3, corner + 8.1, kFeet}, 150);
        return drawWith({.position = {corner + 1.2, corner + 7.9, kFeet + 1.3}, .yaw = 2},
                        std::span(&figure, 1));
    };
    EXPECT_EQ(imageAt(0).rgba, imageAt(1073741824.0).rgba);
}

TEST_F(FigurePassTest, NoneInViewCostsNoDrawCall) {
    EXPECT_FALSE(isFigurePassTimed({}));
    const world::Figure behind = figureOn({-6, 8, kFeet}), ahead = figureOn({6, 8, kFeet});
    EXPECT_FALSE(isFigurePassTimed(std::span(&behind, 1)));
    EXPECT_TRUE(isFigurePassTimed(std::span(&ahead, 1)));
}

// The normals of figures have ten bits.
TEST_F(FigurePassTest, NormalsFollowTheTurn) {
    for (const float yaw : {180.0f, 190.0f, 200.0f, 215.0f, 150.0f}) {
        const world::Figure figure = figureOn({4, 8, kFeet}, yaw);
        const base::Image image =
            drawWith({.position = {2, 8, kFeet + 1}, .yaw = 0}, std::span(&figure, 1), View::Normal);
        const Color normal = pixel(image, kImageSize.x / 2, kImageSize.y / 2);
        const glm::vec3 expected = 127.5f + 127.5f * world::lookDirection(yaw, 0);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(normal[static_cast<std::size_t>(k)], expected[k], 9) << yaw;
    }
}

TEST_F(FigurePassTest, LooksFollowTheNumber) {
    std::vector<Color> shirts;
    for (std::uint32_t look = 0; look < 12; ++look) {
        world::Figure figure = figureOn({4, 8, kFeet}, 180);
        figure.look = look;
        const base::Image image =
            drawWith({.position = {2.5, 8, kFeet + 1}, .yaw = 0}, std::span(&figure, 1));
        shirts.push_back(pixel(image, kImageSize.x / 2, kImageSize.y / 2));
        EXPECT_EQ(image.rgba,
                  drawWith({.position = {2.5, 8, kFeet + 1}, .yaw = 0}, std::span(&figure, 1)).rgba);
    }
    for (std::size_t a = 0; a + 1 < shirts.size(); ++a) {
        int most = 0;
        for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(shirts[a][k] - shirts[a + 1][k]));
        EXPECT_GT(most, 25) << a;
    }
}

}  // namespace
}  // namespace terrane::render
