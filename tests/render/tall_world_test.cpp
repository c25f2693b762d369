// A scene at any height of a world of 4,096 layers looks as in a world of 256: quads, light, culling. Air,
// sky and clouds are off, since they know the altitude.
#include <algorithm>
#include <cmath>
#include <map>

#include "terrane/light/light_area.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/mesh/remesh.h"
#include "terrane/shared/hash.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

constexpr world::Heights kTall{world::kLowestBottom, world::kHighestTop};
constexpr int kSceneSide = 5;  // chunks, of which the inner ones are drawn
constexpr glm::ivec2 kTallImage{160, 120};

// Hills with a cave, a pond, leaves, glass and two lamps.
world::BlockId sceneBlock(int x, int y, int z) {
    const float fx = static_cast<float>(x), fy = static_cast<float>(y);
    const int ground = 92 + static_cast<int>(5 * std::sin(fx / 6) + 4 * std::cos(fy / 5));
    const bool isCave = z > 84 && z < 90 && std::abs(y - 40) < 3;
    if (isCave) return x == 40 && z == 85 ? contentBlock("lamp_blue") : world::kAir;
    if (z < ground) return z < ground - 3 ? contentBlock("stone") : contentBlock("grass");
    if (z < 92) return contentBlock("water");
    const unsigned hash = shared::hash3(static_cast<unsigned>(x / 3), static_cast<unsigned>(y / 3),
                                        static_cast<unsigned>(z / 3), 7);
    if (z < 104 && hash % 23 == 0) return contentBlock("oak_leaves");
    if (z < 104 && hash % 23 == 1) return contentBlock("cyan_glass");
    if (z < 104 && hash % 97 == 2) return contentBlock("lamp_red");
    return z == ground && hash % 5 == 0 ? contentBlock("grass_tuft") : world::kAir;
}

// The scene in a world of 256 layers, with its light.
struct LowScene {
    LowScene() {
        for (int k = 0; k < kSceneSide * kSceneSide; ++k) {
            world::Chunk& chunk = chunks.emplace_back();
            for (int z = 0; z < chunk.heights().top; ++z)
                for (int i = 0; i < 256; ++i) {
                    const world::BlockId id =
                        sceneBlock(16 * (k % kSceneSide) + i % 16, 16 * (k / kSceneSide) + i / 16, z);
                    if (id != world::kAir) chunk.setBlock(world::blockIndex(i % 16, i / 16, z), id);
                }
        }
        light::LightArea area{kSceneSide, kSceneSide, {}};
        for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
        lights = light::lightArea(area, light::LightTable(contentBlocks()));
    }

    std::vector<world::Chunk> chunks;
    std::vector<light::ChunkLight> lights;
};

const LowScene& lowScene() {
    static const LowScene made;
    return made;
}

// A chunk of the tall world: the scene, stone below, air above.
world::Chunk movedChunk(const world::Chunk& from, int sections) {
    world::Chunk chunk(kTall);
    for (int number = kTall.firstSection(); number < kTall.endSection(); ++number) {
        const int old = number - sections;
        if (old < from.heights().firstSection())
            chunk.setSection(number, world::Section(contentBlock("stone")));
        else if (old < from.heights().endSection())
            chunk.setSection(number, from.section(old));
    }
    return chunk;
}

light::ChunkLight movedLight(const light::ChunkLight& from, int sections) {
    light::ChunkLight light(kTall);
    for (int number = kTall.firstSection(); number < kTall.endSection(); ++number) {
        const int old = number - sections;
        if (old >= from.heights().endSection())
            light.setBrick(number, light::LightBrick(light::kFullDaylight));
        else if (old >= from.heights().firstSection())
            light.setBrick(number, from.brick(old));
    }
    return light;
}

class TallWorldTest : public RendererTest {
  protected:
    void configure(int samples, LightSampling light, bool culls, ShadowReach shadows = ShadowReach::Off) {
        RenderOptions options = plainOptions(samples);
        options.light = light;
        options.occlusionCulling = culls;
        options.transparencyLayers = 2;
        options.shadows = shadows;
        options.distanceFog = false;
        const auto done = renderer_->configure(kTallImage, options);
        ASSERT_TRUE(done) << done.error().message;
    }

    // Shows the scene in a world of these heights, moved up by sections.
    void show(world::Heights heights, int sections) {
        renderer_->setHeights(heights);
        renderer_->clearChunks();
        std::vector<world::Chunk> chunks;
        for (const world::Chunk& chunk : lowScene().chunks)
            chunks.push_back(heights == kTall ? movedChunk(chunk, sections) : chunk);
        mesh::MeshScratch scratch;
        for (int y = 1; y < kSceneSide - 1; ++y) {
            for (int x = 1; x < kSceneSide - 1; ++x) {
                const auto at = [&](int dx, int dy) {
                    return static_cast<std::size_t>(x + dx + kSceneSide * (y + dy));
                };
                const mesh::MeshInput input{
                    &chunks[at(0, 0)],
                    {&chunks[at(-1, 0)], &chunks[at(1, 0)], &chunks[at(0, -1)], &chunks[at(0, 1)]},
                    &contentBlocks(),
                    {}};
                ASSERT_TRUE(renderer_->setChunk({x, y}, mesh::meshChunk(input, scratch)));
                const light::ChunkLight& light = lowScene().lights[at(0, 0)];
                ASSERT_TRUE(
                    renderer_->setLight({x, y}, heights == kTall ? movedLight(light, sections) : light));
            }
        }
    }

    // The last of some images: culling depends on the images before.
    base::Image look(Camera camera, int sections, View view = View::Color) {
        camera.position.z += 16 * sections;
        FrameInput input{camera, world::environmentAt(0.4f), 256, 0, view};
        for (int k = 0; k < 2; ++k) renderer_->draw(input);
        return draw(input);
    }

    // A plane of stone that is wider than a shape of the clouds.
    void showPlane(int z, world::Heights heights = kTall) {
        renderer_->setHeights(heights);
        renderer_->clearChunks();
        world::Chunk chunk(heights);
        for (int i = 0; i < 256; ++i)
            chunk.setBlock(world::blockIndex(i % 16, i / 16, z), contentBlock("stone"));
        mesh::MeshScratch scratch;
        const mesh::ChunkMesh mesh = mesh::meshTile(chunk, contentBlocks(), {}, scratch);
        for (int x = -4; x < 4; ++x)
            for (int y = -4; y < 4; ++y) ASSERT_TRUE(renderer_->setChunk({x, y, 6}, mesh));
    }

    static constexpr Camera kCameras[] = {
        {{20, 24, 104}, 40, -25}, {{44, 40, 87}, 180, 2}, {{40, 40, 150}, 70, -80}};
};

struct Differences {
    int largest = 0;
    double mean = 0;  // of channels
};

Differences differencesOf(const base::Image& a, const base::Image& b) {
    Differences found;
    for (std::size_t k = 0; k < a.rgba.size(); ++k) {
        const int d = std::abs(int{a.rgba[k]} - int{b.rgba[k]});
        found.largest = std::max(found.largest, d);
        found.mean += d;
    }
    found.mean /= static_cast<double>(a.rgba.size());
    return found;
}

constexpr int kMoves[] = {-124, -9, 5, 11, 118};  // sections: the scene is at −1,920 … and up to 2,032

// The height of the world alone changes nothing.
TEST_F(TallWorldTest, LooksAsInALowWorld) {
    for (const LightSampling light : {LightSampling::Classic, LightSampling::Smooth}) {
        configure(1, light, true);
        for (const Camera& camera : kCameras) {
            show({}, 0);
            const base::Image low = look(camera, 0);
            show(kTall, 0);
            EXPECT_TRUE(look(camera, 0).rgba == low.rgba);
        }
    }
}

// Positions are less exact far from z = 0, so that few pixels at edges show another surface.
TEST_F(TallWorldTest, LooksTheSameAtAnyHeight) {
    for (const int samples : {1, 4}) {
        for (const LightSampling light : {LightSampling::Classic, LightSampling::Smooth}) {
            configure(samples, light, true);
            std::vector<base::Image> expected;
            show(kTall, 0);
            for (const Camera& camera : kCameras) expected.push_back(look(camera, 0));
            for (const int sections : kMoves) {
                show(kTall, sections);
                for (std::size_t k = 0; k < std::size(kCameras); ++k) {
                    const Differences found = differencesOf(look(kCameras[k], sections), expected[k]);
                    EXPECT_LT(found.mean, 0.06)
                        << samples << " samples, camera " << k << " moved by " << sections;
                }
            }
        }
    }
}

// Culling on the GPU leaves out nothing that is visible.
TEST_F(TallWorldTest, CullingChangesNothing) {
    for (const int sections : kMoves) {
        show(kTall, sections);
        for (const Camera& camera : kCameras) {
            configure(4, LightSampling::Classic, false);
            const base::Image all = look(camera, sections);
            configure(4, LightSampling::Classic, true);
            EXPECT_TRUE(look(camera, sections).rgba == all.rgba) << sections;
        }
    }
}

// Texels of shadow maps lie elsewhere on the scene.
TEST_F(TallWorldTest, ShadowsFallAtAnyHeight) {
    configure(4, LightSampling::Classic, true);
    show(kTall, 0);
    const base::Image bright = look(kCameras[0], 0);
    configure(4, LightSampling::Classic, true, ShadowReach::Far);
    const base::Image shaded = look(kCameras[0], 0);
    ASSERT_GT(differencesOf(bright, shaded).mean, 2);
    for (const int sections : kMoves) {
        show(kTall, sections);
        EXPECT_LT(differencesOf(look(kCameras[0], sections), shaded).mean, 0.6) << sections;
    }
}

// The other views take the same ways.
TEST_F(TallWorldTest, DebugViewsShowAnyHeight) {
    configure(1, LightSampling::Classic, true);
    for (const View view : {View::Normal, View::Depth, View::Light}) {
        show(kTall, 0);
        const base::Image expected = look(kCameras[0], 0, view);
        for (const int sections : {-124, 118}) {
            show(kTall, sections);
            EXPECT_LT(differencesOf(look(kCameras[0], sections, view), expected).mean, 0.06);
        }
    }
}

// An edit at any height replaces its mesh section and its brick of light.
TEST_F(TallWorldTest, EditsAtAnyHeight) {
    configure(1, LightSampling::Classic, true);
    for (const int z : {-2048, -1, 1900, 2047}) {
        show(kTall, 0);
        world::Chunk chunk(kTall);
        const world::Chunk air(kTall);
        mesh::MeshInput input{&chunk, {&air, &air, &air, &air}, &contentBlocks(), {}};
        mesh::MeshScratch scratch;
        light::ChunkLight light(kTall);
        for (int number = kTall.firstSection(); number < kTall.endSection(); ++number)
            light.setBrick(number, light::LightBrick(light::kFullDaylight));
        renderer_->setChunk({0, 0}, mesh::meshChunk(input, scratch));
        renderer_->setLight({0, 0}, light);
        const Camera camera{{-6, 8, z + 3.0}, 0, -15};
        const FrameInput frame{camera, world::environmentAt(0.5f), 256, 0, View::Color};
        const base::Image before = draw(frame);
        chunk.setBlock(world::blockIndex(8, 8, z), contentBlock("lamp_red"));
        const mesh::MeshSectionSet touched = mesh::meshSectionsTouchedBy({8, 8, z})[0].meshSections;
        ASSERT_TRUE(renderer_->setChunk({0, 0}, buildMeshSections(input, touched, scratch), touched));
        const base::Image shown = draw(frame);
        EXPECT_GT(differencesOf(before, shown).mean, 0.1) << z;
        world::SectionSet bricks;
        bricks.add(z >> 4);
        light.setBrick(z >> 4, light::LightBrick(light::kDark));
        ASSERT_TRUE(renderer_->setLight({0, 0}, light, bricks));
        EXPECT_GT(differencesOf(shown, draw(frame)).mean, 0.02) << z;
        chunk.setBlock(world::blockIndex(8, 8, z), world::kAir);
        ASSERT_TRUE(renderer_->setChunk({0, 0}, buildMeshSections(input, touched, scratch), touched));
        EXPECT_TRUE(draw(frame).rgba == before.rgba) << z;
    }
}

// Light, quads and records take what the scene needs; the height adds the grid's entries.
TEST_F(TallWorldTest, MemoryFollowsTheContent) {
    configure(1, LightSampling::Classic, true);
    show({}, 0);
    const GpuMemory low = renderer_->memory();
    const std::size_t quads = renderer_->quadBytes();
    show(kTall, 3);
    EXPECT_EQ(renderer_->quadBytes(), quads);
    const std::size_t entries = 64 * 64 * static_cast<std::size_t>(kTall.sections() - 16) * 4;
    EXPECT_EQ(renderer_->memory().light, low.light + entries);
    EXPECT_EQ(renderer_->memory().meshSections, low.meshSections);
}

TEST_F(TallWorldTest, LightNeedsTheHeightsOfTheWorld) {
    renderer_->setHeights({});
    EXPECT_THROW(renderer_->setLight({0, 0}, light::ChunkLight(kTall)), std::invalid_argument);
}

// From below, from inside and from above: clouds come and go without a jump while the camera climbs.
TEST_F(TallWorldTest, OneCanClimbThroughTheClouds) {
    show(kTall, 0);
    RenderOptions options = plainOptions(1);
    options.clouds = true;
    ASSERT_TRUE(renderer_->configure(kTallImage, options));
    const auto at = [&](double z, float pitch, bool hasClouds) {
        options.clouds = hasClouds;
        EXPECT_TRUE(renderer_->configure(kTallImage, options));
        return draw({{{40, 40, z}, 70, pitch}, world::environmentAt(0.4f), 4000, 0, View::Color});
    };
    for (const float pitch : {-60.0f, 35.0f}) {
        base::Image before = at(330, pitch, true);
        for (double z = 331; z <= 390; z += 1) {
            base::Image now = at(z, pitch, true);
            EXPECT_LT(differencesOf(before, now).mean, 8) << z << ", pitch " << pitch;
            before = std::move(now);
        }
    }
    EXPECT_LE(differencesOf(at(300, -60, true), at(300, -60, false)).largest, 1) << "none below";
    EXPECT_GT(differencesOf(at(300, 35, true), at(300, 35, false)).mean, 2) << "above";
    EXPECT_LE(differencesOf(at(1200, 35, true), at(1200, 35, false)).largest, 1) << "none above";
    EXPECT_GT(differencesOf(at(1200, -60, true), at(1200, -60, false)).mean, 2) << "below";
}

// Air and clouds count from the sea of the world: all moved up look as before.
TEST_F(TallWorldTest, AirAndCloudsLieOverTheSea) {
    RenderOptions options = plainOptions(1);
    options.clouds = true;
    ASSERT_TRUE(renderer_->configure(kTallImage, options));
    const auto lookFrom = [&](double z, float pitch, int up) {
        renderer_->setAirLevels({80.0f + static_cast<float>(up), 360.0f + static_cast<float>(up)});
        return draw({{{40, 40, z + up}, 70, pitch}, world::environmentAt(0.4f), 4000, 0, View::Color});
    };
    for (const auto& [z, pitch] :
         {std::pair{104.0, -4.0f}, {104.0, 35.0f}, {350.0, -10.0f}, {900.0, -60.0f}}) {
        show(kTall, 0);
        const base::Image here = lookFrom(z, pitch, 0);
        for (const int sections : {-24, 40}) {
            show(kTall, sections);
            EXPECT_LT(differencesOf(lookFrom(z, pitch, 16 * sections), here).mean, 0.06)
                << z << " " << sections;
        }
    }
    renderer_->setAirLevels({});
}

// Ground higher than the clouds is behind them for a camera below, and so is low ground for a camera above.
TEST_F(TallWorldTest, CloudsAreBeforeWhatIsBeyondThem) {
    RenderOptions options = plainOptions(4);
    const auto difference = [&](const Camera& camera) {
        std::vector<base::Image> images;
        for (const bool hasClouds : {false, true}) {
            options.clouds = hasClouds;
            EXPECT_TRUE(renderer_->configure({64, 48}, options));
            images.push_back(draw({camera, world::environmentAt(0.4f), 1e5, 0, View::Color}));
        }
        return differencesOf(images[0], images[1]);
    };
    showPlane(100);
    EXPECT_EQ(difference({{8, 8, 200}, 0, -80}).largest, 0) << "both below";
    EXPECT_GT(difference({{8, 8, 1500}, 0, -80}).mean, 1) << "seen from above";
    showPlane(1000);
    EXPECT_GT(difference({{8, 8, 200}, 0, 80}).mean, 1) << "seen from below";
    EXPECT_EQ(difference({{8, 8, 1500}, 0, -80}).largest, 0) << "both above";
}

// The air before a plane up to 4,096 blocks away, 60 blocks lower: thinner in the heights, in the depths as
// near 0.
TEST_F(TallWorldTest, AirIsThinnerInTheHeightsAndNotThickerInTheDepths) {
    const auto airBefore = [&](int z) {
        showPlane(z);
        std::vector<base::Image> images;
        for (const bool hasAir : {false, true}) {
            RenderOptions options = plainOptions(1);
            options.distanceFog = hasAir;
            EXPECT_TRUE(renderer_->configure(kTallImage, options));
            images.push_back(
                draw({{{8, 8, z + 60.0}, 0, -4}, world::environmentAt(0.4f), 1e5, 0, View::Color}));
        }
        return differencesOf(images[0], images[1]).mean;
    };
    const double atSea = airBefore(64), at0 = airBefore(-16);
    EXPECT_GT(atSea, 1);
    EXPECT_LT(airBefore(1100), 0.7 * atSea);
    EXPECT_LT(airBefore(1900), airBefore(1100));
    for (const int z : {-300, -1000, -2000}) EXPECT_NEAR(airBefore(z), at0, 0.5 * at0) << z;
}

// Shadows of the land on a plane, in 16 bits and in floats.
TEST_F(TallWorldTest, LandShadesTheDistance) {
    RenderOptions options = plainOptions(1);
    options.distanceFog = false;
    const auto drawPlane = [&](world::Heights heights, int z, bool hasLand) {
        showPlane(z, heights);
        options.shadows = hasLand ? ShadowReach::Horizon : ShadowReach::Off;
        EXPECT_TRUE(renderer_->configure(kTallImage, options));
        EXPECT_TRUE(renderer_->useLand(hasLand));
        const Camera camera{{8, 8, z + 90.0}, 0, -8};
        if (hasLand) {
            renderer_->setLandReach(4000);
            const world::ChunkPos chunk = cameraChunk(camera);
            for (const world::ChunkPos pos : renderer_->landClipmap().missing(chunk, 4000, SIZE_MAX)) {
                world::LandTile land;
                const double width = world::columnWidth(pos.level);
                for (std::size_t k = 0; k < land.height.size(); ++k) {
                    const double x = (16.0 * pos.x + static_cast<double>(k % 16)) * width;
                    land.height[k] = static_cast<std::int16_t>(z + 60 + std::lround(90 * std::sin(x / 400)));
                    land.ground[k] = contentBlock("stone");
                }
                renderer_->setLand(pos, land);
            }
            renderer_->completeLand();
        }
        const FrameInput input{camera, world::environmentAt(0.3f), 1e5, 0, View::Color};
        base::Image image = draw(input);
        EXPECT_TRUE(renderer_->useLand(false));
        return image;
    };
    const base::Image low = drawPlane({}, 80, true);
    ASSERT_GT(differencesOf(low, drawPlane({}, 80, false)).mean, 1);
    EXPECT_LT(differencesOf(low, drawPlane({-512, 768}, 80, true)).mean, 0.1);
    for (const int z : {80, -1900, 1700})
        EXPECT_LT(differencesOf(low, drawPlane(kTall, z, true)).mean, 0.1) << z;
}

}  // namespace
}  // namespace terrane::render
