// Width of shadow edges.
#include <algorithm>

#include "tests/render/sunlit_fixture.h"

namespace terrane::render {
namespace {

constexpr int kPlainTop = 64;  // highest blocks of the plain

class SoftShadowTest : public SunlitTest {
  protected:
    // Pixels between dark and light at the shadow edge of a wall of this height, seen straight from above.
    int edgePixels(int height, bool isSoft) {
        show(stoneWorld({-2, -2}, {2, 2},
                        std::array<StoneBox, 2>{{{{{-32, -32, 60}, {47, 47, kPlainTop}}},
                                                 {{{0, -32, kPlainTop + 1}, {0, 47, kPlainTop + height}}}}}));
        const Camera above{
            .position = {1.0 + height, 0.5, kPlainTop + 7.0}, .yaw = 0, .pitch = -90, .fieldOfView = 20};
        const world::Environment sun = sunAt(towardSun(180, 45));
        configure(ShadowReach::Off);
        const std::vector<int> bare = column(drawUnder(above, sun));
        configure(ShadowReach::Near, isSoft);
        const std::vector<int> shaded = column(drawUnder(above, sun));
        int count = 0, dark = 0;
        for (std::size_t k = 0; k < bare.size(); ++k) {
            dark += 2 * shaded[k] <= bare[k];
            count += 10 * shaded[k] < 9 * bare[k] && 10 * shaded[k] > 6 * bare[k];
        }
        EXPECT_GT(dark, kSunlitSize.y / 4) << "the edge is in the image";
        return count;
    }

  private:
    // Across the edge, in the middle of the image.
    static std::vector<int> column(const base::Image& image) {
        std::vector<int> values;
        for (int y = 0; y < kSunlitSize.y; ++y)
            values.push_back(image.rgba[4 * static_cast<std::size_t>(y * kSunlitSize.x + kSunlitSize.x / 2)]);
        return values;
    }
};

// Edges are wider if the caster is farther away.
TEST_F(SoftShadowTest, EdgesWidenWithDistance) {
    const int low = edgePixels(3, true), high = edgePixels(20, true);
    EXPECT_GE(high, 2 * low);
    EXPECT_LE(edgePixels(20, false), high / 2) << "a hard edge has the width of a texel";
}

// Between sun and moon there are no maps.
TEST_F(SoftShadowTest, WithoutLightNothingIsShaded) {
    show(stoneWorld({-2, -2}, {2, 2}, std::array<StoneBox, 1>{{{{{-32, -32, 60}, {47, 47, kPlainTop}}}}}));
    const Camera camera{.position = {-20, 0, kPlainTop + 9.0}, .yaw = 0, .pitch = -20};
    world::Environment dark = sunAt(towardSun(180, 45), 0);
    configure(ShadowReach::Off);
    const base::Image bare = drawUnder(camera, dark);
    for (const bool isSoft : {false, true}) {
        configure(ShadowReach::Far, isSoft);
        EXPECT_EQ(drawUnder(camera, dark).rgba, bare.rgba) << isSoft;
    }
}

}  // namespace
}  // namespace terrane::render
