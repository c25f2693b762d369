// Light on the GPU as images show it: a plane with one lamp, at night, seen from above.
#include "terrane/render/quads/light_store.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>

#include "terrane/light/light_area.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/frame/renderer.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"
#include "tests/support/default_heights.h"

namespace terrane::render {
namespace {

class LightImageTest : public gpu::GlTest {
  protected:
    // A stone plane of 5×5 chunks with a lamp in the middle chunk, which is at `middle`.
    struct Scene {
        world::ChunkPos middle;
        int x = 8, y = 8, z = 100;  // of the lamp; the plane's top is at z
        bool isLit = true;
    };

    Renderer makeRenderer() {
        // Quads stretch their texture as their edges move outward; quads of several sizes are compared here,
        // on one grid. OpenGL 4.5 (Implementation Dependent Values) allows coarser ones.
        gpu::DeviceInfo device = gpu::queryDevice();
        device.subpixelBits = 8;
        auto made = Renderer::create(contentShaders(), contentBlocks(), contentTexture, device);
        EXPECT_TRUE(made);
        RenderOptions options = plainOptions(1);
        options.light = sampling_;
        EXPECT_TRUE(made->configure({96, 96}, options));
        return std::move(*made);
    }

    void load(Renderer& renderer, const Scene& scene) {
        constexpr int kSide = 5;
        std::vector<world::Chunk> chunks(kSide * kSide);
        for (world::Chunk& chunk : chunks) {
            for (int k = 0; k < 256; ++k) {
                chunk.setBlock(world::blockIndex(k % 16, k / 16, scene.z - 1), contentBlock("stone"));
            }
        }
        if (scene.isLit) {
            chunks[12].setBlock(world::blockIndex(scene.x, scene.y, scene.z), contentBlock("lamp_red"));
        }
        light::LightArea area{kSide, kSide, {}};
        for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
        const auto lights = light::lightArea(area, light::LightTable(contentBlocks()));
        for (int cy = 1; cy < 4; ++cy) {
            for (int cx = 1; cx < 4; ++cx) {
                const auto at = [&](int dx, int dy) {
                    return static_cast<std::size_t>(cx + dx + kSide * (cy + dy));
                };
                const world::ChunkPos pos{scene.middle.x + cx - 2, scene.middle.y + cy - 2};
                mesh::MeshInput input;
                input.center = &chunks[at(0, 0)];
                input.neighbors = {&chunks[at(-1, 0)], &chunks[at(1, 0)], &chunks[at(0, -1)],
                                   &chunks[at(0, 1)]};
                input.blocks = &contentBlocks();
                mesh::MeshScratch scratch;
                renderer.setChunk(pos, mesh::meshChunk(input, scratch));
                renderer.setLight(pos, lights[at(0, 0)]);
            }
        }
    }

    // From 14 blocks above the lamp, so that borders of chunks and light tiles are in the image at any place.
    base::Image draw(Renderer& renderer, const Scene& scene) {
        const Camera camera{.position = {scene.middle.x * 16.0 + scene.x + 0.5,
                                         scene.middle.y * 16.0 + scene.y + 0.5, scene.z + 14.0},
                            .yaw = 90,
                            .pitch = -90};
        renderer.draw({camera, world::environmentAt(0.0f), 4096, 0, View::Color});
        return renderer.readImage();
    }

    base::Image imageOf(const Scene& scene) {
        Renderer renderer = makeRenderer();
        load(renderer, scene);
        return draw(renderer, scene);
    }

    static int largestDifference(const base::Image& a, const base::Image& b) {
        int largest = 0;
        for (std::size_t k = 0; k < a.rgba.size(); ++k) {
            largest = std::max(largest, std::abs(int{a.rgba[k]} - int{b.rgba[k]}));
        }
        return largest;
    }

    LightSampling sampling_ = LightSampling::Classic;

    static int redAt(const base::Image& image, int x, int y) {
        return image.rgba[4 * static_cast<std::size_t>(x + y * image.width)];
    }
};

TEST_F(LightImageTest, ALampShines) {
    const base::Image with = imageOf({}), without = imageOf({.middle = {}, .isLit = false});
    EXPECT_GT(redAt(with, 48, 60), redAt(without, 48, 60) + 60);
    EXPECT_GT(redAt(with, 48, 60), redAt(with, 48, 94) + 20) << "it falls with distance";
}

// Borders of light tiles (8 blocks) and chunks (16) are at other places in each of these; the image is the
// same except for the steps of filtered fetches, also of the stone texture, and dither. Without the nodes
// beyond a border it would differ by 20 and more.
TEST_F(LightImageTest, BordersCannotBeSeen) {
    const base::Image reference = imageOf({{0, 0}, 4, 4, 100});
    for (const Scene& scene :
         {Scene{{0, 0}, 8, 8, 100}, Scene{{0, 0}, 15, 15, 100}, Scene{{0, 0}, 0, 12, 100},
          Scene{{0, 0}, 4, 4, 104}, Scene{{0, 0}, 4, 4, 96}, Scene{{0, 0}, 7, 8, 112}}) {
        EXPECT_LE(largestDifference(imageOf(scene), reference), 5)
            << scene.x << ' ' << scene.y << ' ' << scene.z;
    }
}

// Smooth light takes nodes with even coordinates from farther away: places of one parity give one image.
TEST_F(LightImageTest, BordersCannotBeSeenInSmoothLight) {
    sampling_ = LightSampling::Smooth;
    const base::Image reference = imageOf({{0, 0}, 4, 4, 100});
    for (const Scene& scene :
         {Scene{{0, 0}, 8, 8, 100}, Scene{{0, 0}, 14, 14, 100}, Scene{{0, 0}, 0, 12, 100},
          Scene{{0, 0}, 4, 4, 104}, Scene{{0, 0}, 6, 8, 112}, Scene{{-1, 3}, 2, 0, 96}}) {
        EXPECT_LE(largestDifference(imageOf(scene), reference), 5)
            << scene.x << ' ' << scene.y << ' ' << scene.z;
    }
    EXPECT_LE(largestDifference(imageOf({{0, 0}, 15, 7, 100}), reference), 16) << "the other parity";
}

// Difference in brightness of a point on the axis and one on the diagonal at the same distance from the lamp.
TEST_F(LightImageTest, SmoothLightIsRounder) {
    constexpr int kAxis = 34, kDiagonal = 24;  // pixels; 34 / √2
    const auto excess = [&](LightSampling sampling) {
        sampling_ = sampling;
        const base::Image image = imageOf({});
        return redAt(image, 48 + kAxis, 48) - redAt(image, 48 + kDiagonal, 48 + kDiagonal);
    };
    const int classic = excess(LightSampling::Classic), smooth = excess(LightSampling::Smooth);
    EXPECT_GT(classic, 12) << "the diamond";
    EXPECT_LT(3 * smooth, 2 * classic);
}

TEST_F(LightImageTest, FarAwayItIsTheSame) {
    const base::Image reference = imageOf({{0, 0}, 4, 4, 100});
    EXPECT_LE(largestDifference(imageOf({{1000, -777}, 4, 4, 100}), reference), 2);
    EXPECT_LE(largestDifference(imageOf({{-1, -1}, 4, 4, 100}), reference), 2);
}

TEST_F(LightImageTest, LightThatChangesReplacesTheOld) {
    Renderer renderer = makeRenderer();
    load(renderer, {});
    load(renderer, {.middle = {}, .isLit = false});
    EXPECT_EQ(largestDifference(draw(renderer, {}), imageOf({.middle = {}, .isLit = false})), 0);
    load(renderer, {});
    EXPECT_EQ(largestDifference(draw(renderer, {}), imageOf({})), 0);
}

// After a long flight new chunks have light at the grid places of old ones, which are removed later.
TEST_F(LightImageTest, AChunkThatIsFarAwayTakesNoLightAlong) {
    Renderer renderer = makeRenderer();
    renderer.setLight({-1024, 1024}, light::ChunkLight());
    load(renderer, {});
    const base::Image before = draw(renderer, {});
    renderer.removeChunk({-1024, 1024});
    EXPECT_EQ(largestDifference(draw(renderer, {}), before), 0);
    EXPECT_EQ(largestDifference(before, imageOf({})), 0);
}

// Two rooms of stone whose only contact is an edge, a lamp in one.
class LightCornerTest : public LightImageTest {
  protected:
    // The darker room's floor at the edge, from above; without the lamp's room it would be as dark as
    // everywhere.
    int redBesideTheEdge(LightSampling sampling, bool isLit) {
        sampling_ = sampling;
        Renderer renderer = makeRenderer();
        std::vector<world::Chunk> chunks(9);
        const auto set = [&](int x, int y, int z, std::string_view name) {
            chunks[static_cast<std::size_t>(x / 16 + 3 * (y / 16))].setBlock(
                world::blockIndex(x & 15, y & 15, z), contentBlock(name));
        };
        for (int k = 0; k < 48 * 48; ++k) {
            const int x = k % 48, y = k / 48;
            const bool isRoom = (x < 24) == (y < 24) && x > 16 && x < 31 && y > 16 && y < 31;
            set(x, y, 99, "stone");
            if (!isRoom) {
                for (int z = 100; z < 104; ++z) set(x, y, z, "stone");
            }
            set(x, y, 104, "stone");
        }
        if (isLit) set(26, 26, 100, "lamp_red");
        loadChunks(renderer, chunks);
        // In the dark room, over the block at its corner.
        const Camera camera{.position = {23.5, 23.5, 103.0}, .yaw = 90, .pitch = -90};
        renderer.draw({camera, world::environmentAt(0.0f), 4096, 0, View::Color});
        const base::Image image = renderer.readImage();
        int brightest = 0;
        for (int y = 40; y < 56; ++y) {
            for (int x = 40; x < 56; ++x) brightest = std::max(brightest, redAt(image, x, y));
        }
        return brightest;
    }

    void loadChunks(Renderer& renderer, const std::vector<world::Chunk>& chunks) {
        light::LightArea area{3, 3, {}};
        for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
        const auto lights = light::lightArea(area, light::LightTable(contentBlocks()));
        mesh::MeshScratch scratch;
        const mesh::MeshInput input{
            &chunks[4], {&chunks[3], &chunks[5], &chunks[1], &chunks[7]}, &contentBlocks(), {}};
        renderer.setChunk({1, 1}, mesh::meshChunk(input, scratch));
        for (int k = 0; k < 9; ++k) renderer.setLight({k % 3, k / 3}, lights[static_cast<std::size_t>(k)]);
    }
};

TEST_F(LightCornerTest, SmoothLightDoesNotLeak) {
    const int dark = redBesideTheEdge(LightSampling::Classic, false);
    EXPECT_GT(redBesideTheEdge(LightSampling::Classic, true), dark + 15) << "classic light does";
    EXPECT_LE(redBesideTheEdge(LightSampling::Smooth, true),
              redBesideTheEdge(LightSampling::Smooth, false) + 1);
}

class LightStoreTest : public gpu::GlTest {};

constexpr std::size_t kEntryBytes = 8 * 4, kBrickBytes = 8 * 1024 + kEntryBytes;

TEST_F(LightStoreTest, UploadsTheBricksThatChanged) {
    std::array<world::Section::Value, world::kBlocksPerSection> values{};
    light::ChunkLight light;
    for (int n = 0; n < 4; ++n) {
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] = static_cast<world::Section::Value>(k + static_cast<std::size_t>(n));
        light.setBrick(n, world::Section::fromValues(values));
    }
    LightStore store(2);
    const auto brick = [](int number) {
        world::SectionSet set;
        set.add(number);
        return set;
    };
    store.set({0, 0}, light, brick(0));  // a chunk that is new is taken as a whole
    EXPECT_EQ(store.uploadedTiles(), 4u * 8);
    const std::size_t bytes = store.usedBytes();
    light.setBrick(2, world::Section(7));
    light.setBrick(3, light.brick(0));
    store.set({0, 0}, light, brick(2));
    EXPECT_EQ(store.uploadedTiles(), 4u * 8) << "one value needs no light tile";
    EXPECT_EQ(store.usedBytes(), bytes - kBrickBytes);
    store.set({0, 0}, light, brick(3));
    EXPECT_EQ(store.uploadedTiles(), 5u * 8);
    EXPECT_EQ(store.usedBytes(), bytes - kBrickBytes);
    store.remove({0, 0});
    EXPECT_EQ(store.usedBytes(), bytes - 4 * kBrickBytes);
}

light::ChunkLight noiseLight() {
    std::mt19937 random(5);
    light::ChunkLight noise;
    for (int n = 0; n < world::kSectionsPerChunk; ++n) {
        std::array<world::Section::Value, world::kBlocksPerSection> values;
        for (auto& v : values) v = static_cast<world::Section::Value>(random());
        noise.setBrick(n, world::Section::fromValues(values));
    }
    return noise;
}

// 4,096 light tiles are enough for 32 chunks of noise; other chunks keep only the middle of each light tile
// until there is room.
TEST_F(LightImageTest, APoolThatCannotGrowKeepsWhatFits) {
    constexpr std::size_t kPoolBytes = 4096 * 1024;
    LightStore store(2, 1);
    const std::size_t gridBytes = store.usedBytes();
    const light::ChunkLight noise = noiseLight();
    for (int x = 0; x < 40; ++x) store.set({x % 8, x / 8}, noise, {});
    EXPECT_EQ(store.usedBytes(), gridBytes + kPoolBytes + 40 * 16 * kEntryBytes);
    EXPECT_EQ(store.uploadedTiles(), 4096u);
    for (int x = 0; x < 40; ++x) store.remove({x % 8, x / 8});
    EXPECT_EQ(store.usedBytes(), gridBytes);
    store.set({0, 0}, noise, {});
    EXPECT_EQ(store.uploadedTiles(), 4096u + 128);
}

// Chunks of noise fill the pool until it grows; what it had stays, and what is removed is used again.
TEST_F(LightImageTest, ThePoolGrowsAndKeepsWhatItHas) {
    Renderer renderer = makeRenderer();
    renderer.setViewDistance(8);  // 8,192 light tiles at first
    load(renderer, {});
    const base::Image before = draw(renderer, {});
    const std::size_t bytesBefore = renderer.lightBytes();
    const light::ChunkLight noise = noiseLight();
    const auto forFarChunks = [](const std::function<void(world::ChunkPos)>& use) {
        for (int y = 4; y <= 9; ++y)
            for (int x = -9; x <= 9; ++x) use({x, y});
    };
    forFarChunks([&](world::ChunkPos pos) { renderer.setLight(pos, noise); });
    EXPECT_GT(renderer.lightBytes(), bytesBefore + 6 * 19 * 120 * 1024);
    EXPECT_EQ(largestDifference(draw(renderer, {}), before), 0);
    const std::size_t full = renderer.lightBytes();
    forFarChunks([&](world::ChunkPos pos) { renderer.removeChunk(pos); });
    EXPECT_EQ(renderer.lightBytes(), bytesBefore);
    forFarChunks([&](world::ChunkPos pos) { renderer.setLight(pos, noise); });
    EXPECT_EQ(renderer.lightBytes(), full);
    EXPECT_EQ(largestDifference(draw(renderer, {}), before), 0);
}

}  // namespace
}  // namespace terrane::render
