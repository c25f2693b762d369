// Images with shadow maps that are kept from frame to frame.
#include "terrane/render/shadow/shadow_map.h"

#include <algorithm>

#include "tests/golden/scenes.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

constexpr glm::ivec2 kSize{192, 128};
constexpr std::size_t kFewTiles = 3;

class ShadowMapTest : public RendererTest {
  protected:
    static RenderOptions options(ShadowReach reach, bool isSoft = false) {
        RenderOptions o = plainOptions(1);
        o.shadows = reach;
        o.shadowSize = 1024;
        o.softShadows = isSoft;
        o.occlusionCulling = o.distanceFog = false;
        return o;
    }
    void configure(ShadowReach reach, bool isSoft = false) {
        ASSERT_TRUE(renderer_->configure(kSize, options(reach, isSoft)));
    }
    void show(const world::World& world) {
        for (const auto& [pos, mesh] : golden::meshWorld(world)) renderer_->setChunk(pos, mesh);
    }
    base::Image drawAt(const Camera& camera, float time, std::size_t maxTiles = ShadowClipmap::kAllTiles) {
        FrameInput input{camera, world::environmentAt(time), 1000, 0, View::Color};
        input.maxShadowTiles = maxTiles;
        return draw(input);
    }
};

void placeTower(world::World& world, int x, int y, int height) {
    for (int z = 0; z < height; ++z)
        world::putBlock(world, {x, y, golden::kGalleryZ + z}, contentBlock("stone"));
}

// Pixels whose colors differ by more than `most`.
int differentPixels(const base::Image& a, const base::Image& b, int most) {
    int count = 0;
    for (std::size_t k = 0; k < a.rgba.size(); k += 4) {
        int largest = 0;
        for (std::size_t c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(int{a.rgba[k + c]} - int{b.rgba[k + c]}));
        count += largest > most;
    }
    return count;
}

constexpr int kPixels = kSize.x * kSize.y;

// Walks while a tower comes and goes, few tiles a frame; then the maps are those of a renderer that has seen
// nothing.
TEST_F(ShadowMapTest, AWalkEndsWithTheMapsOfAFreshRenderer) {
    configure(ShadowReach::Far);
    world::World without = golden::flatWorld(6), with = golden::flatWorld(6);
    for (world::World* world : {&without, &with}) placeTower(*world, -6, 9, 7);
    placeTower(with, 4, 2, 12);
    const golden::Meshes meshes[] = {golden::meshWorld(without), golden::meshWorld(with)};
    const world::ChunkPos changing{0, 0};
    show(with);
    Camera camera{{-36, 1, 95}, -12, -28};  // stays at one anchor
    drawAt(camera, 0.33f);
    for (int step = 0; step < 40; ++step) {
        camera.position += glm::dvec3(0.45, 0.1, 0.05);
        camera.yaw += 0.3f;
        renderer_->setChunk(changing, meshes[step / 7 % 2].at(changing));
        drawAt(camera, 0.33f, kFewTiles);
    }
    renderer_->setChunk(changing, meshes[0].at(changing));
    const base::Image walked = drawAt(camera, 0.33f);
    renderer_->clearChunks();
    show(without);
    const base::Image fresh = drawAt(camera, 0.33f);
    EXPECT_LE(differentPixels(walked, fresh, 8), kPixels / 2000);
    show(with);
    EXPECT_GT(differentPixels(drawAt(camera, 0.33f), fresh, 8), kPixels / 200) << "the tower can be seen";
}

// Level ground has no shadow on it in any cascade.
TEST_F(ShadowMapTest, LevelGroundDoesNotShadeItself) {
    show(golden::flatWorld(14));
    const Camera camera{{-190, 5, 130}, 3, -14};
    for (const float time : {0.22f, 0.3f, 0.5f, 0.78f}) {
        configure(ShadowReach::Off);
        const base::Image bare = drawAt(camera, time);
        for (const bool isSoft : {false, true}) {
            configure(ShadowReach::Far, isSoft);
            EXPECT_LE(differentPixels(drawAt(camera, time), bare, 2), kPixels / 500) << time << " " << isSoft;
        }
    }
}

TEST_F(ShadowMapTest, TowersCastShadowsInEachCascade) {
    world::World world = golden::flatWorld(14);
    for (const int y : {-150, -60, 120})
        for (int x = -3; x < 3; ++x) placeTower(world, x, y, 20);
    show(world);
    const Camera camera{{0, -205, 150}, 90, -25};  // across the light
    configure(ShadowReach::Off);
    const base::Image bare = drawAt(camera, 0.3f);
    configure(ShadowReach::Near);
    const int near = differentPixels(drawAt(camera, 0.3f), bare, 8);
    configure(ShadowReach::Far);
    const int far = differentPixels(drawAt(camera, 0.3f), bare, 8);
    EXPECT_GT(far, near + 20);
}

// Shadows do not crawl: a hundredth of a block changes next to nothing.
TEST_F(ShadowMapTest, ShadowsStandStillWhileTheCameraMoves) {
    world::World world = golden::flatWorld(8);
    golden::placeGallery(world);
    for (const int x : {-40, -20, 30}) placeTower(world, x, x / 4, 15);
    show(world);
    configure(ShadowReach::Far);
    Camera camera{{-60, 4, 100}, 5, -20};
    base::Image before = drawAt(camera, 0.3f);
    for (int step = 0; step < 20; ++step) {
        camera.position.x += 0.01;
        camera.position.z += 0.003;
        base::Image now = drawAt(camera, 0.3f);
        EXPECT_LE(differentPixels(now, before, 24), kPixels / 400) << step;
        before = std::move(now);
    }
}

}  // namespace
}  // namespace terrane::render
