// No sun inside of closed rooms, in any cascade. Chunks have no light here, so only the shadow map keeps the
// sun out.
#include "tests/render/sunlit_fixture.h"
#include "tests/support/depth.h"

namespace terrane::render {
namespace {

constexpr int kRoomLength = 704;  // within the reach of the last cascade

class ClosedRoomTest : public SunlitTest {
  protected:
    // A tunnel along x in walls one block thick, one of them along the border of chunks. Inner size.
    struct Tunnel {
        int width, height;
    };
    void showTunnel(Tunnel t, int floor = 80, world::Heights heights = {}) {
        tunnel_ = t;
        floor_ = floor;
        const StoneBox boxes[] = {{{{0, 0, floor}, {kRoomLength - 1, t.width + 1, floor + t.height + 1}}},
                                  {{{1, 1, floor + 1}, {kRoomLength - 2, t.width, floor + t.height}}, true}};
        renderer_->setHeights(heights);
        show(stoneWorld({0, 0}, {kRoomLength / world::kChunkSize - 1, 1}, boxes, heights));
    }
    // Steps of the brightest pixel over one without the sun, from one end of the tunnel.
    int brightestUnderAnySun(float fieldOfView, float yaw = 0) {
        const int kSuns = atDepth(7, 24);
        const Camera camera{
            {yaw == 0 ? 3.0 : kRoomLength - 4, 1 + 0.5 * tunnel_.width, floor_ + 1 + 0.5 * tunnel_.height},
            yaw,
            0,
            fieldOfView};
        int most = 0;
        for (int k = 0; k < kSuns; ++k) {
            const glm::vec3 sun =
                towardSun(137.5f * static_cast<float>(k), 1.0f + 88.0f * static_cast<float>(k) / (kSuns - 1));
            const std::vector<int> steps =
                stepsBrighter(drawUnder(camera, sunAt(sun)), drawUnder(camera, sunAt(sun, 0)));
            most = std::max(most, std::ranges::max(steps));
        }
        return most;
    }
    Tunnel tunnel_{};
    int floor_ = 0;
};

// Fields of view of 70, 6 and 1 degrees show what lies in the first, second and third cascade.
TEST_F(ClosedRoomTest, RoomsAreDarkInEachCascade) {
    for (const Tunnel& tunnel : {Tunnel{14, 10}, {14, 3}, {2, 3}}) {
        showTunnel(tunnel);
        for (const bool isSoft : {false, true}) {
            configure(ShadowReach::Far, isSoft);
            for (const float field : {70.0f, 6.0f, 1.0f})
                EXPECT_LE(brightestUnderAnySun(field), 2) << tunnel.width << " " << isSoft << " " << field;
            EXPECT_LE(brightestUnderAnySun(6, 180), 2) << "toward -x";
        }
    }
}

// Positions on the GPU have the height as it is: near the ends of the highest world they are less exact.
TEST_F(ClosedRoomTest, RoomsAtTheEndsOfTheHighestWorldAreDark) {
    constexpr world::Heights kHighest{world::kLowestBottom, world::kHighestTop};
    for (const int floor : {world::kLowestBottom + 3, world::kHighestTop - 24}) {
        showTunnel({14, 3}, floor, kHighest);
        for (const bool isSoft : {false, true}) {
            configure(ShadowReach::Far, isSoft);
            for (const float field : {70.0f, 6.0f, 1.0f})
                EXPECT_LE(brightestUnderAnySun(field), 2) << floor << " " << isSoft << " " << field;
        }
    }
}

// One block wide: in the last cascade points are moved into the adjacent wall, so only near points are
// tested.
TEST_F(ClosedRoomTest, NarrowCorridorsAreDarkNearby) {
    showTunnel({1, 2});
    for (const bool isSoft : {false, true}) {
        configure(ShadowReach::Far, isSoft);
        EXPECT_LE(brightestUnderAnySun(70), 1) << isSoft;
    }
}

}  // namespace
}  // namespace terrane::render
