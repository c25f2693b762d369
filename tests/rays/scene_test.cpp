#include "terrane/rays/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "tests/rays/ray_world.h"
#include "tests/support/depth.h"

namespace terrane::rays {
namespace {

std::string describe(const shared::Ray& ray, const shared::RayHit& expected, const shared::RayHit& actual) {
    const auto text = [](const shared::RayHit& hit) {
        return fmt::format("face {} of {},{},{} of level {} at {:a}", hit.face, hit.cell.x, hit.cell.y,
                           hit.cell.z, hit.level, hit.t);
    };
    return fmt::format(
        "from {},{},{} + {:a},{:a},{:a} mirrored {},{},{} along {:a},{:a},{:a}: expected {}, got {}",
        ray.cell.x, ray.cell.y, ray.cell.z, ray.start.x, ray.start.y, ray.start.z, ray.mirror.x, ray.mirror.y,
        ray.mirror.z, ray.direction.x, ray.direction.y, ray.direction.z, text(expected), text(actual));
}

// Returns the number of rays that hit something.
int compareRays(const RayWorld& made, const Scene& scene, int rays, std::mt19937& random) {
    int hits = 0, wrong = 0;
    for (int k = 0; k < rays && wrong < 5; ++k) {
        const shared::Ray ray = randomRay(made, random);
        const shared::RayHit expected = slowCast(made, scene, ray);
        const shared::RayHit actual = shared::castRay(raysThrough(scene), ray);
        hits += expected.face != shared::kRayMiss;
        if (isSame(expected, actual)) continue;
        ++wrong;
        ADD_FAILURE() << describe(ray, expected, actual);
    }
    return hits;
}

TEST(SceneTest, RaysEqualASlowWalkToTheBit) {
    std::mt19937 random(1);
    const int worlds = 40, rays = atDepth(1'000'000, 10'000'000) / worlds;
    int hits = 0;
    for (int k = 0; k < worlds && !testing::Test::HasFailure(); ++k) {
        const RayWorld made = randomWorld(random, 1 + k % 4);
        hits += compareRays(made, made.scene(), rays, random);
    }
    EXPECT_GT(hits, worlds * rays / 4);
    EXPECT_LT(hits, worlds * rays * 9 / 10);
}

// Rays leave the world there; nothing comes back in at the other end.
TEST(SceneTest, RaysLeaveTheWorldAtItsEdge) {
    std::mt19937 random(5);
    for (int k = 0; k < 6; ++k) {
        const RayWorld made = worldAround({world::kMaxChunk, world::kMinChunk + 3}, random, 1 + k % 3);
        EXPECT_GT(compareRays(made, made.scene(), 20'000, random), 2'000);
    }
}

// The cells of a scene, wherever its words are: for each level the window, what each entry is, and the
// sections of tiles.
std::vector<shared::uint> cellsOf(const Scene& scene) {
    using namespace shared;
    const auto& words = scene.words;
    std::vector<uint> cells(words.begin(), words.begin() + kRayHeaderWords);
    const uint tiles = 1u << (2 * scene.sideBits);
    for (uint k = 0; k < tiles * static_cast<uint>(scene.levels); ++k) {
        const uint what = words[kRayHeaderWords + kRayEntryWords * k];
        const uint heights = words[kRayHeaderWords + kRayEntryWords * k + 1];
        cells.push_back(std::min(what, kRayTile));
        cells.push_back(heights);
        if (what < kRayTile) continue;
        const int sections = ((rayTopOf(heights) + 15) >> 4) - rayLowestSectionOf(heights);
        for (int s = 0; s < std::max(sections, 1); ++s) {
            const uint node = words[what + static_cast<uint>(s)];
            cells.push_back(std::min(node, kRayFull + 1));
            if (node <= kRayFull) continue;
            for (const uint part : {node, node + kRayHalfWords}) {
                cells.push_back(words[part + kRayAny]);
                cells.push_back(words[part + kRayPartial]);
                const auto leaves = words.begin() + words[part + kRayLeaves];
                cells.insert(cells.end(), leaves, leaves + 2 * std::popcount(words[part + kRayPartial]));
            }
        }
    }
    return cells;
}

TEST(SceneTest, EditsEqualARebuild) {
    std::mt19937 random(2);
    for (int worldNumber = 0; worldNumber < atDepth(6, 60); ++worldNumber) {
        RayWorld made = randomWorld(random, 1 + worldNumber % 3);
        Scene scene = made.scene();
        std::vector<world::ChunkPos> positions;
        for (const auto& [pos, chunk] : made.tiles) positions.push_back(pos);
        ASSERT_FALSE(positions.empty());
        for (int edit = 0; edit < 300; ++edit) {
            const world::ChunkPos pos = positions[random() % positions.size()];
            world::Chunk& chunk = made.tiles.at(pos);
            const int number = made.heights.firstSection() +
                               static_cast<int>(random() % static_cast<unsigned>(made.heights.sections()));
            if (random() % 4 == 0) {
                chunk.setSection(number, randomSection(random));
            } else {
                for (int k = 0; k < 3; ++k) {
                    chunk.setBlock(4096 * number + static_cast<int>(random() % 4096),
                                   static_cast<world::BlockId>(random() % 3));
                }
            }
            SectionCells cells;
            buildCells(cells, chunk.section(number), kStops);
            setSection(scene, pos, number, cells);
            if (edit % 20 == 0) {
                ASSERT_EQ(cellsOf(scene), cellsOf(made.scene())) << edit;
            }
        }
        const Scene rebuilt = made.scene();
        EXPECT_EQ(cellsOf(scene), cellsOf(rebuilt));
        EXPECT_EQ(scene.wordsInUse, rebuilt.wordsInUse);
        EXPECT_LT(scene.words.size(), 2 * rebuilt.words.size()) << "freed words are used again";
        compareRays(made, scene, 5'000, random);
    }
}

TEST(SceneTest, TilesComeAndGo) {
    std::mt19937 random(3);
    RayWorld made = randomWorld(random, 3);
    Scene scene = made.scene();
    const std::size_t all = scene.wordsInUse;
    const std::vector<shared::uint> cells = cellsOf(scene);
    for (int round = 0; round < 5; ++round) {
        for (const auto& [pos, chunk] : made.tiles) {
            EXPECT_TRUE(hasTile(scene, pos));
            removeTile(scene, pos);
            EXPECT_FALSE(hasTile(scene, pos));
        }
        Scene empty = makeScene(made.heights, made.levels, made.sideBits);
        moveScene(empty, made.center);
        EXPECT_EQ(scene.wordsInUse, empty.wordsInUse);
        EXPECT_EQ(cellsOf(scene), cellsOf(empty));
        for (const auto& [pos, chunk] : made.tiles) setTile(scene, pos, buildColumn(chunk, kStops));
        EXPECT_EQ(scene.wordsInUse, all);
        EXPECT_EQ(cellsOf(scene), cells);
    }
}

// Tiles that a window leaves behind are gone; those that stay are found in their new places.
TEST(SceneTest, TheWindowMoves) {
    std::mt19937 random(4);
    RayWorld made = randomWorld(random, 3);
    Scene scene = made.scene();
    for (const world::ChunkPos step : {world::ChunkPos{1, 0}, {3, -2}, {-5, 7}, {9, 9}, {100, 0}, {-99, 5}}) {
        made.center = {made.center.x + step.x, made.center.y + step.y};
        moveScene(scene, made.center);
        std::erase_if(made.tiles, [&](const auto& tile) { return !isInWindow(scene, tile.first); });
        EXPECT_EQ(cellsOf(scene), cellsOf(made.scene()));
        compareRays(made, scene, 5'000, random);
        for (int k = 0; k < 20; ++k) {
            const world::ChunkPos pos = world::offsetBy(made.center, static_cast<int>(random() % 3) - 1,
                                                        static_cast<int>(random() % 3) - 1);
            bool isCovered = false;
            for (int level = 0; level < made.levels; ++level) {
                isCovered |=
                    made.tiles.contains({pos.x >> level, pos.y >> level, static_cast<std::uint8_t>(level)});
            }
            if (isCovered) continue;
            const auto added = made.tiles.emplace(pos, randomChunk(made.heights, random)).first;
            setTile(scene, pos, buildColumn(added->second, kStops));
        }
    }
}

// Copies the words that changed to another place, as for shaders.
void follow(Scene& scene, std::vector<std::uint32_t>& copy) {
    copy.resize(scene.words.size());
    takeWritten(scene, [&](std::size_t first, std::size_t count) {
        std::copy_n(scene.words.begin() + static_cast<long>(first), count,
                    copy.begin() + static_cast<long>(first));
    });
}

TEST(SceneTest, ACopyFollowsAllChanges) {
    std::mt19937 random(6);
    RayWorld made = randomWorld(random, 2);
    Scene scene = made.scene();
    std::vector<std::uint32_t> copy;
    follow(scene, copy);
    ASSERT_EQ(copy, scene.words);
    SectionCells cells;
    for (int change = 0; change < 200; ++change) {
        for (const auto& [pos, chunk] : made.tiles) {
            if (random() % 4 != 0) continue;
            const bool isThere = hasTile(scene, pos);
            if (isThere && random() % 2 == 0) {
                removeTile(scene, pos);
            } else if (isThere) {
                buildCells(cells, randomSection(random), kStops);
                setSection(scene, pos, made.heights.firstSection(), cells);
            } else if (isFree(scene, pos)) {
                setTile(scene, pos, buildColumn(chunk, kStops));
            }
        }
        if (change % 10 == 0) moveScene(scene, {made.center.x + change % 3, made.center.y});
        follow(scene, copy);
        ASSERT_EQ(copy, scene.words) << change;
    }
    std::size_t rest = 0;
    takeWritten(scene, [&](std::size_t, std::size_t count) { rest += count; });
    EXPECT_EQ(rest, 0u);
}

// A place is free inside the window, unless a tile of any level covers a part of it.
TEST(SceneTest, OnlyUncoveredPlacesAreFree) {
    Scene scene = makeScene({}, 3, 4);
    const world::ChunkPos middle{1, 1, 1};
    EXPECT_TRUE(isFree(scene, middle));
    EXPECT_FALSE(isFree(scene, {8, 0, 1}));
    setTile(scene, middle, buildColumn(world::Chunk(), kStops));
    EXPECT_FALSE(isFree(scene, middle));
    EXPECT_FALSE(isFree(scene, {2, 3, 0}));
    EXPECT_FALSE(isFree(scene, {0, 0, 2}));
    EXPECT_TRUE(isFree(scene, {0, 1, 1}));
    EXPECT_TRUE(isFree(scene, {1, 0, 2}));
}

// Ids that no table has are of unknown blocks; sections that are not made consist of such.
TEST(SceneTest, UnknownBlocksStopRays) {
    SectionCells cells;
    buildCells(cells, world::Section(world::kUnmade), kStops);
    EXPECT_EQ(cells.state, shared::kRayFull);
    world::Section section(world::kAir);
    section.set(17, 999);
    buildCells(cells, section, kStops);
    EXPECT_EQ(cells.size, shared::kRayNodeWords + shared::kRayLeafWords);
    EXPECT_EQ(cells.words[shared::kRayNodeWords], 1u << 5);  // x 1, y 1
}

TEST(SceneTest, UniformSectionsTakeOneWord) {
    RayWorld made;
    world::Chunk chunk(made.heights);
    for (int number = -2; number < 3; ++number) chunk.setSection(number, world::Section(kStone));
    made.tiles.emplace(made.center, chunk);
    EXPECT_EQ(made.scene().wordsInUse - makeScene(made.heights, 1, made.sideBits).wordsInUse, 2u);
}

// What remains of a ray is cast from where it was stopped, and ends are included.
TEST(SceneTest, RaysGoOnAndEnd) {
    RayWorld made;
    world::Chunk chunk(made.heights);
    for (const int x : {3, 4, 9}) chunk.setBlock(world::blockIndex(x, 2, 5), kStone);
    made.tiles.emplace(made.center, chunk);
    const Scene scene = made.scene();
    shared::Ray ray = shared::makeRay({0, 2, 5, 0}, {.5f, .5f, .5f, 0}, {1, 0, 0, 0}, 1e9f);
    shared::RayPlace place = shared::rayBegin(ray);
    for (const int x : {3, 4, 9}) {
        const shared::RayHit hit = shared::castRayFrom(raysThrough(scene), ray, place);
        EXPECT_EQ(hit.cell, glm::ivec4(x, 2, 5, 0));
        EXPECT_EQ(hit.face, 0u);
        shared::rayLeaveBox(ray, place, place.cell + 1);
    }
    EXPECT_EQ(shared::castRayFrom(raysThrough(scene), ray, place).face, shared::kRayMiss);
    const float t = shared::castRay(raysThrough(scene), ray).t;
    EXPECT_NEAR(t, 2.5f, 1e-5f);
    ray.start.w = t;
    EXPECT_EQ(shared::castRay(raysThrough(scene), ray).face, 0u);
    ray.start.w = std::nextafter(t, 0.f);
    EXPECT_EQ(shared::castRay(raysThrough(scene), ray).face, shared::kRayMiss);
}

}  // namespace
}  // namespace terrane::rays
