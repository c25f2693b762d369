// Land to the horizon on screen: no holes where levels meet, the same light as nearby, nothing left behind.
#include "terrane/view/far_view.h"

#include <cstdlib>
#include <glm/trigonometric.hpp>
#include <random>

#include "terrane/view/camera_path.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr glm::ivec2 kFarSize{96, 64};
constexpr int kNear = 4, kFar = 128;
constexpr double kFarBlocks = kFar * 16.0;

class FarViewTest : public gpu::GlTest {
  protected:
    static constexpr glm::dvec3 kPlaces[] = {{-1020, -60, 120}, {8, 8, 140}, {1318, -790, 150}};

    std::unique_ptr<DrawnSession> load(const render::Camera& camera, int horizon, int detail = 8) {
        auto player = makeDrawnSession({.size = kFarSize, .viewDistance = kNear});
        player->view->setHorizon({horizon, detail});
        loadAll(*player->session, *player->view, camera, kNear, std::chrono::steady_clock::now());
        return player;
    }

    static render::FrameInput inputAt(const render::Camera& camera, render::View view) {
        return {camera, world::environmentAt(0.5f), 2 * fogDistance(kFar), 0, view};
    }

    // A place.
    static int cameraCount() { return atDepth(12, 200); }

    // In the camera's chunk.
    static int highestBlock(const DrawnSession& player, const render::Camera& camera) {
        const world::Chunk chunk = player.session->generator().generate(render::cameraChunk(camera));
        for (int k = world::kBlocksPerChunk - 1; k > 0; --k) {
            if (chunk.block(static_cast<world::BlockIndex>(k)) != world::kAir) return k >> 8;
        }
        return 0;
    }

    // Pixels that show nothing although their rays meet the bottom of the world within the horizon.
    static int holes(const base::Image& normals, const render::Camera& camera) {
        const double scale = std::tan(glm::radians(camera.fieldOfView) / 2) * 2 / kFarSize.y;
        const glm::dvec3 look = render::lookDirection(camera), right = render::rightDirection(camera);
        const glm::dvec3 up = glm::cross(right, look);
        int count = 0;
        for (int y = 0; y < kFarSize.y; ++y) {
            for (int x = 0; x < kFarSize.x; ++x) {
                const std::size_t at = 4 * static_cast<std::size_t>(x + y * kFarSize.x);
                if (normals.rgba[at] + normals.rgba[at + 1] + normals.rgba[at + 2] > 0) continue;
                const glm::dvec3 ray = look + right * (scale * (x + 0.5 - kFarSize.x / 2.0)) +
                                       up * (scale * (kFarSize.y / 2.0 - y - 0.5));
                const double steps = ray.z < 0 ? camera.position.z / -ray.z : 1e9;
                count += steps * std::hypot(ray.x, ray.y) < 0.8 * kFarBlocks;
            }
        }
        return count;
    }
};

TEST_F(FarViewTest, ThereAreNoHoles) {
    std::mt19937 random(7);
    const auto within = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
    };
    for (const glm::dvec3& place : kPlaces) {
        const auto player = load({place}, kFar);
        for (int k = 0; k < cameraCount(); ++k) {
            // Near and far from where chunks end, from the ground to high above.
            const double reach = k % 2 == 0 ? 100 : 600;
            render::Camera camera{
                {place.x + within(-reach, reach), place.y + within(-reach, reach), within(100, 250)},
                static_cast<float>(within(0, 360)),
                static_cast<float>(within(-90, -5))};
            camera.position.z = std::max(camera.position.z, highestBlock(*player, camera) + 2.0);
            const base::Image image = player->draw(inputAt(camera, render::View::Normal));
            EXPECT_EQ(holes(image, camera), 0)
                << camera.position.x << ',' << camera.position.y << ',' << camera.position.z << " look "
                << camera.yaw << ' ' << camera.pitch;
        }
    }
}

// Chunks vanish behind the camera and tiles come ahead of it: what is there covers the land in every frame.
TEST_F(FarViewTest, AFastFlightShowsNoHoles) {
    render::Camera camera{{8, 8, 220}, 0, -40};
    const auto player = load(camera, kFar);
    for (int frame = 0; frame < 60; ++frame) {
        camera.position.x += 13;  // 200 blocks a second at 15 frames
        camera.yaw += 6;
        player->view->follow(camera, kNear);
        player->view->upload(0.004);
        const base::Image image = player->draw(inputAt(camera, render::View::Normal));
        EXPECT_EQ(holes(image, camera), 0) << "frame " << frame;
    }
}

// Far land that appears from behind near land is in the very next image.
TEST_F(FarViewTest, HiddenLandIsNeverMissed) {
    render::Camera camera{{-1020, -60, 120}, 0, -5};
    const auto player = load(camera, kFar);
    std::size_t quadsOfAll = 0, quadsOfVisible = 0;
    for (int frame = 0; frame < 40; ++frame) {
        camera.position += glm::dvec3(2, 1, frame % 20 < 10 ? -4 : 4);
        camera.yaw += 9;
        std::array<base::Image, 2> images;
        for (const bool culls : {false, true}) {
            render::RenderOptions options = render::plainOptions(1);
            options.tJunctions = render::TJunctions::Open;
            options.occlusionCulling = culls;
            ASSERT_TRUE(player->renderer.configure(kFarSize, options));
            images[culls] = player->draw(inputAt(camera, render::View::Color));
            (culls ? quadsOfVisible : quadsOfAll) += player->renderer.statistics().quads;
        }
        EXPECT_EQ(images[0].rgba, images[1].rgba) << "frame " << frame;
    }
    EXPECT_LT(quadsOfVisible, quadsOfAll * 9 / 10) << "something is hidden";
}

// The tests above see holes: without tiles there are many.
TEST_F(FarViewTest, WithoutAHorizonThereAreHoles) {
    const render::Camera camera{{8, 8, 200}, 30, -20};
    const auto player = load(camera, 0);
    EXPECT_GT(holes(player->draw(inputAt(camera, render::View::Normal)), camera), 100);
}

// Far tiles have no light of their own: they lie under the open sky, wherever chunks with light are.
TEST_F(FarViewTest, FarLandIsAsBrightAsNearLand) {
    const render::Camera camera{{-1020, -60, 240}, 0, -90};
    const auto player = load(camera, kFar);
    const base::Image image = player->draw(inputAt(camera, render::View::Light));
    // Half a view of 70 degrees from 150 blocks above the ground is 105 blocks wide; chunks end at 64.
    for (const int x : {2, kFarSize.x - 3}) {
        EXPECT_GT(image.rgba[4 * static_cast<std::size_t>(x + kFarSize.x * kFarSize.y / 2)], 200) << x;
    }
}

// A camera that goes away and comes back sees what it saw.
TEST_F(FarViewTest, ComingBackShowsTheSame) {
    const render::Camera home{{8, 8, 140}, 30, -15}, away{{900, 8, 140}, 30, -15};
    const auto player = load(home, kFar);
    const base::Image before = player->draw(inputAt(home, render::View::Color));
    for (const render::Camera& camera : {away, home})
        loadAll(*player->session, *player->view, camera, kNear, std::chrono::steady_clock::now());
    const auto fresh = load(home, kFar);
    const base::Image after = player->draw(inputAt(home, render::View::Color));
    EXPECT_EQ(before.rgba, fresh->draw(inputAt(home, render::View::Color)).rgba);
    int different = 0;
    for (std::size_t k = 0; k < before.rgba.size(); ++k) different += before.rgba[k] != after.rgba[k];
    EXPECT_LT(different, 0.02 * static_cast<double>(before.rgba.size())) << "tiles near a border may stay";
}

// Waves of nearby water end before land beyond the chunks begins: no gap between the two shows the sea floor.
TEST_F(FarViewTest, WaterMeetsWaterWithoutGaps) {
    constexpr glm::ivec2 kWide{320, 180};
    constexpr int kChunks = 8;
    render::RenderOptions options = render::plainOptions(1);
    options.animation = true;
    const auto player = makeDrawnSession({.size = kWide, .viewDistance = kChunks, .render = options});
    player->view->setHorizon({kFar, 8});
    const render::Camera camera{{850, -520, 190}, 205, -38, 30};  // nothing but sea
    loadAll(*player->session, *player->view, camera, kChunks, std::chrono::steady_clock::now());
    int dots = 0;
    for (const float seconds : {0.0f, 1.3f, 2.6f}) {
        render::FrameInput input = inputAt(camera, render::View::Color);
        input.timeSeconds = seconds;
        const base::Image image = player->draw(input);
        const auto sumAt = [&](int x, int y) {
            const std::size_t at = 4 * static_cast<std::size_t>(x + y * kWide.x);
            return image.rgba[at] + image.rgba[at + 1] + image.rgba[at + 2];
        };
        for (int y = 1; y < kWide.y - 1; ++y) {
            for (int x = 0; x < kWide.x; ++x) {
                const int above = sumAt(x, y - 1), below = sumAt(x, y + 1), here = sumAt(x, y);
                dots += std::abs(here - above) > 90 && std::abs(here - below) > 90;
            }
        }
    }
    EXPECT_LE(dots, 2);
}

// Far water has the color of near water, and so has its floor, which gets no light of its own.
TEST_F(FarViewTest, FarWaterLooksLikeNearWater) {
    constexpr glm::ivec2 kWide{160, 96};
    constexpr int kBlock = 16;
    const render::Camera camera{{850, -520, 190}, 205, -38, 30};  // nothing but sea, 80 to 260 blocks away
    const auto imageWith = [&](int viewDistance, int horizon) {
        const auto player = makeDrawnSession({.size = kWide, .viewDistance = viewDistance});
        player->view->setHorizon({horizon, 16});
        loadAll(*player->session, *player->view, camera, viewDistance, std::chrono::steady_clock::now());
        return player->draw(inputAt(camera, render::View::Color));
    };
    const base::Image far = imageWith(8, kFar), near = imageWith(18, 0);
    for (int y0 = 0; y0 < kWide.y; y0 += kBlock) {
        for (int x0 = 0; x0 < kWide.x; x0 += kBlock) {
            double difference = 0;
            for (int k = 0; k < kBlock * kBlock; ++k) {
                const std::size_t at =
                    4 * static_cast<std::size_t>(x0 + k % kBlock + kWide.x * (y0 + k / kBlock));
                for (std::size_t c = 0; c < 3; ++c) difference += far.rgba[at + c] - near.rgba[at + c];
            }
            EXPECT_LT(std::abs(difference) / (3 * kBlock * kBlock), 3) << x0 << ',' << y0;
        }
    }
}

TEST_F(FarViewTest, WithoutAHorizonNothingIsLeft) {
    const render::Camera camera{{8, 8, 140}, 30, -15};
    const auto player = load(camera, kFar), none = load(camera, 0);
    EXPECT_GT(player->renderer.quadBytes(), 2 * none->renderer.quadBytes());
    player->view->setHorizon({});
    loadAll(*player->session, *player->view, camera, kNear, std::chrono::steady_clock::now());
    EXPECT_EQ(player->renderer.quadBytes(), none->renderer.quadBytes());
    EXPECT_EQ(player->draw(inputAt(camera, render::View::Color)).rgba,
              none->draw(inputAt(camera, render::View::Color)).rgba);
}

}  // namespace
}  // namespace terrane::view
