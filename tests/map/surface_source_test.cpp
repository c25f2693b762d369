#include "terrane/map/surface_source.h"

#include <gmock/gmock.h>

#include <map>
#include <optional>
#include <thread>

#include "terrane/store/overlay_store.h"
#include "tests/base/file_size_limit.h"
#include "tests/base/temp_folder.h"
#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

using testing::HasSubstr;
using world::ChunkPos;
using Chunks = std::vector<ChunkPos>;

constexpr std::int64_t kCacheBytes = 64 << 20;

// The 256 chunks of a blob.
Chunks chunksOfBlob(BlobPos blob) {
    Chunks chunks;
    for (int k = 0; k < 256; ++k) chunks.push_back({blob.x * 16 + k % 16, blob.y * 16 + k / 16, blob.level});
    return chunks;
}

class SurfaceSourceTest : public testing::Test {
  protected:
    static const gen::LevelGenerators& overworld() { return generatorsOf("overworld"); }

    void expectGenerated(SurfaceSource& source, const Chunks& chunks) {
        const auto found = source.surfaces(chunks, {});
        ASSERT_TRUE(found) << found.error().message;
        ASSERT_EQ(found->size(), chunks.size());
        for (std::size_t k = 0; k < chunks.size(); ++k)
            EXPECT_TRUE(*(*found)[k] == generatedSurface(overworld(), chunks[k]))
                << testing::PrintToString(chunks[k]);
    }
    std::unique_ptr<SurfaceCache> openCache() {
        return SurfaceCache::open(folder_ / "map.sqlite", "world", kCacheBytes).value();
    }

    base::TempFolder folder_;
};

// Around the origin and at the corners of the world.
Chunks placesOfLevel(std::uint8_t level) {
    const std::int32_t low = world::kMinChunk >> level, high = world::kMaxChunk >> level;
    return {{0, 0, level},     {-1, -1, level},     {-17, 31, level},   {5, -16, level},
            {low, low, level}, {high, high, level}, {low, high, level}, {0, 0, level}};
}

TEST_F(SurfaceSourceTest, SurfacesAreThoseOfTheGenerator) {
    SurfaceSource source({overworld(), contentKinds()});
    for (const std::uint8_t level : {0, 4, 10}) expectGenerated(source, placesOfLevel(level));
}

TEST_F(SurfaceSourceTest, ACacheChangesNothing) {
    const auto cache = openCache();
    SurfaceSource source({overworld(), contentKinds(), nullptr, cache.get()});
    for (const std::uint8_t level : {0, 4}) {
        expectGenerated(source, placesOfLevel(level));
        expectGenerated(source, chunksOfBlob({-1, 0, level}));
        EXPECT_TRUE(cache->contains({-1, 0, level}));
        EXPECT_FALSE(cache->contains({0, 0, level})) << "not all of its chunks were asked for";
        SurfaceSource again({noGenerators(), contentKinds(), nullptr, cache.get()});
        expectGenerated(again, chunksOfBlob({-1, 0, level}));
        expectGenerated(again, {{-1, 15, level}, {-16, 0, level}});
    }
}

TEST_F(SurfaceSourceTest, WithoutItsLevelAGeneratorIsAnError) {
    SurfaceSource source({noGenerators(), contentKinds()});
    const Chunks chunks = {{0, 0, 0}};
    const auto found = source.surfaces(chunks, {});
    ASSERT_FALSE(found);
    EXPECT_THAT(found.error().message, HasSubstr("nothing is generated here"));
    const ColumnRect rect{0, 0, 0, 3, 3};
    EXPECT_FALSE(source.area(rect, {}));
}

TEST_F(SurfaceSourceTest, NothingIsOutsideTheWorld) {
    SurfaceSource source({overworld(), contentKinds()});
    for (const int level : {0, 4}) {
        const std::int64_t end = (std::int64_t{1} << 31) >> level;  // in columns
        const ColumnRect rect{level, end - 20, -end - 20, 40, 40};
        const auto area = source.area(rect, {});
        ASSERT_TRUE(area) << area.error().message;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x)
                ASSERT_EQ(area->at(x, y).top != world::kAir, x < 20 && y >= 20) << x << ", " << y;
    }
}

TEST_F(SurfaceSourceTest, AnAreaHasEachColumnInItsPlace) {
    SurfaceSource source({overworld(), contentKinds()});
    const ColumnRect rect{0, -37, 5, 50, 21};
    const auto area = source.area(rect, {}).value();
    for (int y = 0; y < rect.height; ++y) {
        for (int x = 0; x < rect.width; ++x) {
            const auto columnX = static_cast<std::int32_t>(rect.x0 + x),
                       columnY = static_cast<std::int32_t>(rect.y0 + y);
            static std::map<ChunkPos, Surface> surfaces;
            const ChunkPos chunk = world::chunkOf(world::BlockPos{columnX, columnY, 0});
            if (!surfaces.contains(chunk)) surfaces[chunk] = generatedSurface(overworld(), chunk);
            ASSERT_EQ(area.at(x, y),
                      surfaces[chunk][static_cast<std::size_t>((columnX & 15) + 16 * (columnY & 15))]);
        }
    }
}

TEST_F(SurfaceSourceTest, ChunksOfARectangleAreRowByRow) {
    EXPECT_EQ(chunksTouching(ColumnRect{3, -1, 15, 2, 2}),
              (Chunks{{-1, 0, 3}, {0, 0, 3}, {-1, 1, 3}, {0, 1, 3}}));
    EXPECT_EQ(chunksTouching(ColumnRect{0, 16, 32, 16, 16}), (Chunks{{1, 2, 0}}));
    for (const ChunkPos chunk :
         chunksTouching(ColumnRect{0, std::int64_t{1} << 40, -(std::int64_t{1} << 40), 9, 9}))
        EXPECT_FALSE(world::isInWorld(chunk));
}

// The column of the pillar of an edited chunk, at 3, 9.
const SurfaceColumn& pillarOf(const SurfacePtr& surface) {
    return (*surface)[3 + 16 * 9];
}
bool hasPillar(const SurfacePtr& surface) {
    return pillarOf(surface) == SurfaceColumn{contentBlock("stone"), contentBlock("stone"), 200, 200};
}
world::ChunkPtr pillarChunk(ChunkPos pos) {
    return chunkWithPillar(generatorsOf("overworld"), pos, 3, 9, "stone");
}

TEST_F(SurfaceSourceTest, EditedChunksAreThoseThatAreGiven) {
    SurfaceSource source({overworld(), contentKinds()});
    const Chunks chunks = {{0, 0}, {-1, 0}, {0, 0, 4}};
    const EditedChunk edited[] = {{{-1, 0}, pillarChunk({-1, 0})}, {{7, 7}, pillarChunk({7, 7})}};
    const auto found = source.surfaces(chunks, edited).value();
    EXPECT_FALSE(hasPillar(found[0]));
    EXPECT_TRUE(hasPillar(found[1]));
    EXPECT_FALSE(hasPillar(found[2]));
    EXPECT_FALSE(hasPillar(source.surfaces(chunks, {}).value()[1])) << "the memory stays unedited";
    // Its other columns are unchanged.
    EXPECT_EQ((*found[1])[0], generatedSurface(overworld(), {-1, 0})[0]);
}

TEST_F(SurfaceSourceTest, EditedChunksAreThoseOfTheStore) {
    store::MemoryStore store({.seed = kMapSeed, .generator = "overworld", .generatorVersion = 1});
    store.save({2, 0}, pillarChunk({2, 0}), store::Provenance::Edited);
    store.save({1, 1, 4}, pillarChunk({1, 1, 4}), store::Provenance::Edited);
    ASSERT_TRUE(store.flush());
    SurfaceSource source({overworld(), contentKinds(), &store});
    const Chunks chunks = {{2, 0}, {3, 0}, {1, 1, 4}};
    const EditedChunk edited[] = {{{2, 0}, nullptr}, {{3, 0}, nullptr}, {{1, 1, 4}, nullptr}};
    const auto found = source.surfaces(chunks, edited).value();
    EXPECT_TRUE(hasPillar(found[0]));
    EXPECT_TRUE(*found[1] == generatedSurface(overworld(), {3, 0})) << "the store has none";
    EXPECT_TRUE(hasPillar(found[2]));
    EXPECT_FALSE(hasPillar(source.surfaces(chunks, {}).value()[0])) << "nobody said that it is edited";
    // A chunk that is passed in has priority over the saved one.
    const auto live = std::make_shared<const world::Chunk>();
    const EditedChunk now[] = {{{2, 0}, live}};
    EXPECT_EQ(pillarOf(source.surfaces(chunks, now).value()[0]), SurfaceColumn());
}

TEST_F(SurfaceSourceTest, TheCacheStaysUnedited) {
    const auto cache = openCache();
    SurfaceSource source({overworld(), contentKinds(), nullptr, cache.get()});
    const Chunks chunks = chunksOfBlob({0, -1, 0});
    const EditedChunk edited[] = {{chunks[100], pillarChunk(chunks[100])}};
    EXPECT_TRUE(hasPillar(source.surfaces(chunks, edited).value()[100]));
    ASSERT_TRUE(cache->contains({0, -1, 0}));
    SurfaceSource again({noGenerators(), contentKinds(), nullptr, cache.get()});
    expectGenerated(again, chunks);
    EXPECT_TRUE(hasPillar(again.surfaces(chunks, edited).value()[100]));
}

TEST_F(SurfaceSourceTest, ThreadsMayAskAtOnce) {
    const auto cache = openCache();
    SurfaceSource source({overworld(), contentKinds(), nullptr, cache.get()});
    const Chunks chunks = chunksOfBlob({3, 3, 0});
    const EditedChunk edited[] = {{chunks[7], pillarChunk(chunks[7])}};
    std::vector<std::vector<SurfacePtr>> found(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < found.size(); ++t)
        threads.emplace_back([&, t] { found[t] = source.surfaces(chunks, edited).value(); });
    for (std::thread& thread : threads) thread.join();
    SurfaceSource alone({overworld(), contentKinds()});
    const auto expected = alone.surfaces(chunks, edited).value();
    for (const auto& each : found) {
        ASSERT_EQ(each.size(), expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_TRUE(*each[k] == *expected[k]);
    }
}

TEST_F(SurfaceSourceTest, ABlobIsWrittenOnceAllOfItIsThere) {
    const auto cache = openCache();
    SurfaceSource source({overworld(), contentKinds(), nullptr, cache.get()});
    const Chunks chunks = chunksOfBlob({2, -1, 4});
    // Some of it, with chunks of other blobs, as an isometric tile or a fine one asks for.
    for (std::size_t first = 0; first < 256; first += 64) {
        EXPECT_FALSE(cache->contains({2, -1, 4}));
        Chunks some(chunks.begin() + static_cast<std::ptrdiff_t>(first),
                    chunks.begin() + static_cast<std::ptrdiff_t>(first) + 64);
        some.push_back({0, 0, 4});
        const EditedChunk edited[] = {{chunks[70], pillarChunk(chunks[70])}};
        ASSERT_TRUE(source.surfaces(some, first == 64 ? edited : std::span<const EditedChunk>()));
    }
    EXPECT_TRUE(cache->contains({2, -1, 4}));
    EXPECT_FALSE(cache->contains({0, 0, 4}));
    SurfaceSource again({noGenerators(), contentKinds(), nullptr, cache.get()});
    expectGenerated(again, chunks);
}

TEST_F(SurfaceSourceTest, ABrokenCacheChangesNothing) {
    if (!base::FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    const auto cache = openCache();
    SurfaceSource source({overworld(), contentKinds(), nullptr, cache.get()});
    {
        const base::FileSizeLimit full(std::filesystem::file_size(folder_ / "map.sqlite"));
        expectGenerated(source, chunksOfBlob({0, 0, 0}));
    }
    EXPECT_TRUE(cache->isBroken());
    expectGenerated(source, chunksOfBlob({1, 0, 4}));
    EXPECT_FALSE(cache->contains({1, 0, 4}));
}

// Returns what a test sets for each chunk, and counts the calls.
class ScriptedStore : public store::ReadableStore {
  public:
    std::map<ChunkPos, store::LoadedChunk> chunks;
    int calls = 0, loads = 0;

    store::LoadedChunk load(ChunkPos pos) override {
        ++loads;
        const auto found = chunks.find(pos);
        return found != chunks.end() ? found->second : store::LoadedChunk();
    }
    std::vector<store::LoadedChunk> loadMany(std::span<const ChunkPos> positions) override {
        ++calls;
        return ReadableStore::loadMany(positions);
    }
    bool contains(ChunkPos pos) override { return chunks.contains(pos); }
    base::Result<Chunks> editedChunks() override { return Chunks(); }
    std::optional<std::string> metadata(std::string_view) override { return std::nullopt; }
    const store::WorldIdentity& identity() const override { return identity_; }

  private:
    store::WorldIdentity identity_;
};

TEST_F(SurfaceSourceTest, EditedChunksAreLoadedByOneCall) {
    ScriptedStore store;
    store.chunks[{1, 0}].chunk = std::make_shared<world::Chunk>(*pillarChunk({1, 0}));
    store.chunks[{3, 0}].chunk = std::make_shared<world::Chunk>(*pillarChunk({3, 0}));
    SurfaceSource source({overworld(), contentKinds(), &store});
    const Chunks chunks = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 0}};
    const EditedChunk edited[] = {
        {{1, 0}, nullptr}, {{3, 0}, nullptr}, {{2, 0}, pillarChunk({2, 0})}, {{9, 9}, nullptr}};
    const auto found = source.surfaces(chunks, edited).value();
    EXPECT_FALSE(hasPillar(found[0]));
    for (std::size_t k = 1; k < chunks.size(); ++k) EXPECT_TRUE(hasPillar(found[k])) << k;
    EXPECT_EQ(store.calls, 1);
    EXPECT_EQ(store.loads, 2) << "those that are asked for and not given, once each";
    ASSERT_TRUE(source.surfaces(chunks, {}));
    EXPECT_EQ(store.calls, 1);
}

TEST_F(SurfaceSourceTest, AChunkThatCouldNotBeReadIsAnError) {
    ScriptedStore store;
    store::LoadedChunk& unread = store.chunks[{5, -6}];
    unread.state = store::LoadedChunk::State::Damaged;
    unread.problem = "the network broke";
    unread.isUnreadable = true;
    SurfaceSource source({overworld(), contentKinds(), &store});
    const Chunks chunks = {{4, -6}, {5, -6}};
    const EditedChunk edited[] = {{{5, -6}, nullptr}};
    const auto found = source.surfaces(chunks, edited);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, base::ErrorCode::Io);
    EXPECT_EQ(found.error().message, "chunk 5,-6: the network broke");
    // Chunks that are damaged, or too large for the memory, count as generated, as in a game.
    unread.isOverBudget = true;
    const auto asGenerated = [&] {
        const auto surfaces = source.surfaces(chunks, edited);
        return surfaces && *(*surfaces)[1] == generatedSurface(overworld(), {5, -6});
    };
    EXPECT_TRUE(asGenerated());
    unread.isUnreadable = unread.isOverBudget = false;
    EXPECT_TRUE(asGenerated());
}

}  // namespace
}  // namespace terrane::map
