// A shadow along a plain continues through all cascades, without a change of brightness where one ends.
#include "tests/render/sunlit_fixture.h"

namespace terrane::render {
namespace {

constexpr int kGroundTop = 81, kWallTop = 101, kStripEnd = 703, kStripHalf = 48;
constexpr float kElevation = 40;

class ShadowSeamTest : public SunlitTest {
  protected:
    static constexpr glm::ivec2 kLarge{320, 180};

    // A wall along x at y from 0 to 1.
    void showWall() {
        const StoneBox boxes[] = {
            {{{0, -kStripHalf, kGroundTop - 1}, {kStripEnd, kStripHalf - 1, kGroundTop - 1}}},
            {{{0, 0, kGroundTop}, {kStripEnd, 0, kWallTop - 1}}}};
        show(stoneWorld({0, -3}, {kStripEnd / world::kChunkSize, 2}, boxes));
    }
    // Point where the pixel's ray meets the plane of the ground; x < 0 if it does not.
    static glm::dvec2 groundAt(const Camera& camera, int x, int y) {
        const ViewMatrices view =
            viewMatrices(camera, static_cast<float>(kLarge.x) / static_cast<float>(kLarge.y));
        const float across = (static_cast<float>(x) + 0.5f) / static_cast<float>(kLarge.x) * 2 - 1;
        const float up = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(kLarge.y) * 2;
        const glm::dvec3 ray(view.ahead + across * view.across + up * view.up);
        if (ray.z >= 0) return glm::dvec2(-1);
        return glm::dvec2(camera.position + ray * ((kGroundTop - camera.position.z) / ray.z));
    }
};

// Pixels near the shadow's edges may be anything: the map moves them by up to four blocks in the last
// cascade.
TEST_F(ShadowSeamTest, AShadowIsEvenThroughAllCascades) {
    constexpr double kMargin = 4;
    const double length = (kWallTop - kGroundTop) / std::tan(kElevation / 57.29578);
    showWall();
    const glm::vec3 sun = towardSun(90, kElevation);
    for (const bool isSoft : {false, true}) {
        for (const auto& [pitch, field] : {std::pair(-25.0f, 50.0f), {-14.0f, 14.0f}, {-5.0f, 8.0f}}) {
            const Camera camera{{4, -20, 125}, 0, pitch, field};
            configure(ShadowReach::Off, isSoft, 2048, kLarge);
            const base::Image lit = drawUnder(camera, sunAt(sun)), dark = drawUnder(camera, sunAt(sun, 0));
            configure(ShadowReach::Far, isSoft, 2048, kLarge);
            const base::Image image = drawUnder(camera, sunAt(sun));
            int shaded = 0, open = 0, wrong = 0;
            for (int y = 0; y < kLarge.y; ++y) {
                for (int x = 0; x < kLarge.x; ++x) {
                    const glm::dvec2 at = groundAt(camera, x, y);
                    if (at.x < 40 || at.x > 690 || at.y < -kStripHalf + 1 || at.y > -kMargin) continue;
                    if (std::abs(at.y + length) < kMargin) continue;
                    const bool isShaded = at.y > -length;
                    const Color expected = pixel(isShaded ? dark : lit, x, y), found = pixel(image, x, y);
                    ++(isShaded ? shaded : open);
                    wrong += std::abs(expected[1] - found[1]) > 1;
                }
            }
            EXPECT_GT(std::min(shaded, open), 500) << field;
            EXPECT_EQ(wrong, 0) << isSoft << " " << field;
        }
    }
}

}  // namespace
}  // namespace terrane::render
