// Random sequences over the rules of tiles: after every step each column is shown once.
#include "terrane/stream/tile_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace terrane::stream {
namespace {

using world::ChunkPos;

// A model of tiles that are made after a while, chunks of level 0 that come and go with the view, and what is
// shown.
class Model {
  public:
    explicit Model(unsigned seed) : random_(seed) {}

    void moveTo(const TileView& view) {
        view_ = view;
        setTileView(table_, view);
        for (auto it = chunks_.begin(); it != chunks_.end();) {
            const bool isLeft = world::chunkDistance(*it, view.center) > view.viewDistance + 1;
            if (isLeft) setChunkReady(table_, *it, false);
            it = isLeft ? chunks_.erase(it) : std::next(it);
        }
        apply();
    }

    // Makes some chunks of level 0 and some tiles.
    void work(int chunks, int tiles) {
        for (int k = 0; k < chunks; ++k) {
            const ChunkPos pos{view_.center.x + pick(-view_.viewDistance, view_.viewDistance),
                               view_.center.y + pick(-view_.viewDistance, view_.viewDistance)};
            if (chunks_.insert(pos).second) setChunkReady(table_, pos, true);
        }
        for (const ChunkPos tile : popTileRequests(table_, static_cast<std::size_t>(tiles)))
            loading_.push_back(tile);
        std::ranges::shuffle(loading_, random_);
        for (int k = 0; k < tiles && !loading_.empty(); ++k) {
            const ChunkPos tile = loading_.back();
            loading_.pop_back();
            if (!isTileLoading(table_, tile)) continue;
            finishTile(table_, tile);
            ++made_;
            ready_.insert(tile);
        }
        apply();
    }

    void finishAll() {
        for (int y = -view_.viewDistance; y <= view_.viewDistance; ++y)
            for (int x = -view_.viewDistance; x <= view_.viewDistance; ++x) {
                const ChunkPos pos = offsetBy(view_.center, x, y);
                if (chunks_.insert(pos).second) setChunkReady(table_, pos, true);
            }
        apply();
        while (missingTiles(table_) > 0) work(0, 1000);
    }

    // Makes some of the shown tiles stale.
    void outdate(int count) {
        for (const ChunkPos pos : shown_) {
            if (pos.level > 0 && pick(0, 9) == 0 && count-- > 0) invalidateTile(table_, pos);
        }
        apply();
    }

    // The number of shown chunks and tiles that cover a chunk of level 0.
    int timesShown(ChunkPos chunk) const {
        int count = 0;
        for (ChunkPos pos = chunk;; pos = parentOf(pos)) {
            count += shown_.contains(pos) ? 1 : 0;
            if (pos.level == coarsestLevel(view_) || pos.level == world::kMaxLevel) return count;
        }
    }

    ChunkPos columnNear(int reach) {
        return {view_.center.x + pick(-reach, reach), view_.center.y + pick(-reach, reach)};
    }
    int pick(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }

    const std::set<ChunkPos>& shown() const { return shown_; }
    const TileTable& table() const { return table_; }
    const TileView& view() const { return view_; }
    int made() const { return made_; }

  private:
    // Only what is ready is shown, only what is shown is hidden.
    void apply() {
        const TileChanges changes = updateTiles(table_);
        for (const ChunkPos pos : changes.hidden) EXPECT_EQ(shown_.erase(pos), 1u);
        for (const ChunkPos pos : changes.shown) {
            EXPECT_TRUE(shown_.insert(pos).second);
            EXPECT_TRUE(pos.level == 0 ? chunks_.contains(pos) : ready_.contains(pos));
        }
        for (const ChunkPos pos : changes.dropped) {
            EXPECT_FALSE(shown_.contains(pos));
            EXPECT_EQ(ready_.erase(pos), 1u);
        }
    }

    TileTable table_;
    TileView view_;
    std::mt19937 random_;
    std::set<ChunkPos> chunks_, ready_, shown_;
    std::vector<ChunkPos> loading_;
    int made_ = 0;
};

TileView viewAt(std::int32_t x, std::int32_t y) {
    return {{x, y}, 8, 256, 8};
}

TEST(TileTable, DistancesCountFromTheNearestChunk) {
    EXPECT_EQ(tileDistance({5, 5}, {2, 2, 1}), 0);  // chunks 4 and 5
    EXPECT_EQ(tileDistance({6, 5}, {2, 2, 1}), 1);
    EXPECT_EQ(tileDistance({-1, 0}, {0, 0, 4}), 1);
    EXPECT_EQ(tileDistance({0, 0}, {-1, -1, 4}), 1);  // chunks -16 to -1
    EXPECT_EQ(tileDistance({0, 0}, {-2, 0, 4}), 17);
    EXPECT_EQ(tileDistance({world::kMaxChunk, 0}, {world::kMinChunk, 0}), (std::int64_t{1} << 28) - 1);
}

TEST(TileTable, ParentsHoldTheirChildrenBelowZeroToo) {
    EXPECT_EQ(parentOf({-1, 1, 3}), (ChunkPos{-1, 0, 4}));
    EXPECT_EQ(firstChildOf({-1, 1, 4}), (ChunkPos{-2, 2, 3}));
}

TEST(TileTable, WithoutAHorizonChunksAreShownAsTheyCome) {
    Model model(1);
    model.moveTo({{0, 0}, 4, 0, 8});
    model.work(50, 10);
    EXPECT_FALSE(model.shown().empty());
    for (const ChunkPos pos : model.shown()) EXPECT_EQ(pos.level, 0);
    EXPECT_EQ(missingTiles(model.table()), 0u);
}

TEST(TileTable, TheCoarsestTilesComeFirstAndCoverEverything) {
    Model model(2);
    model.moveTo(viewAt(0, 0));
    model.work(0, 1);
    const int coarsest = coarsestLevel(model.view());
    EXPECT_EQ(coarsest, 7);
    while (model.timesShown({-256, 256}) + model.timesShown({256, -256}) + model.timesShown({0, 0}) < 3)
        model.work(0, 1);
    EXPECT_LE(model.made(), 36);
    for (const ChunkPos pos : model.shown()) EXPECT_EQ(pos.level, coarsest);
}

// Rings of levels, each about twice as wide as the one before.
TEST(TileTable, TheLevelFollowsFromTheDistance) {
    Model model(3);
    model.moveTo(viewAt(1000, -777));
    model.finishAll();
    std::map<int, std::pair<std::int64_t, std::int64_t>> reaches;
    for (const ChunkPos pos : model.shown()) {
        const std::int64_t distance = tileDistance(model.view().center, pos);
        auto& [nearest, farthest] = reaches.try_emplace(pos.level, distance, distance).first->second;
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
    }
    for (const auto& [level, reach] : reaches) {
        if (level < 2) continue;
        EXPECT_GE(reach.first, (std::int64_t{8} << level) / 2) << level;
        // A parent nearer than its border may have a child beyond it.
        EXPECT_LT(reach.second, std::int64_t{9} << level) << level;
    }
    EXPECT_LE(reaches.at(0).second, 8);
    EXPECT_EQ(reaches.rbegin()->first, 6) << "none coarser than the outermost ring's";
}

class TileWalk : public testing::TestWithParam<unsigned> {};

// Never twice; once wherever the coarsest tiles were there before.
TEST_P(TileWalk, EachColumnIsShownOnce) {
    Model model(GetParam());
    TileView view = viewAt(model.pick(-5000, 5000), model.pick(-5000, 5000));
    model.moveTo(view);
    model.finishAll();
    for (int step = 0; step < 150; ++step) {
        const int kind = model.pick(0, 99);
        const bool jumps = kind == 0;
        if (jumps) view.center = {model.pick(-100000, 100000), model.pick(-100000, 100000)};
        if (kind == 1) view.viewDistance = model.pick(4, 12);
        if (kind == 2) view.detail = model.pick(kMinDetail, 16);
        if (kind > 2) view.center = offsetBy(view.center, model.pick(-1, 2), model.pick(-1, 1));
        model.moveTo(view);
        // After a jump or with other options what is there need not cover anything.
        if (kind < 3) model.finishAll();
        for (int k = 0; k < 200; ++k) {
            const ChunkPos column = model.columnNear(k % 2 == 0 ? view.horizon : 24);
            ASSERT_EQ(model.timesShown(column), 1) << "step " << step << ": " << column.x << ',' << column.y;
        }
        model.outdate(model.pick(0, 5));
        model.work(model.pick(0, 120), model.pick(20, 200));
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, TileWalk, testing::Range(10u, 16u));

// While everything is loaded for the first time, a column is shown at most once.
TEST(TileTable, NothingIsShownTwiceWhileItComes) {
    Model model(4);
    model.moveTo(viewAt(-3, 70));
    while (missingTiles(model.table()) > 0 || model.made() == 0) {
        model.work(40, 30);
        for (int k = 0; k < 100; ++k) ASSERT_LE(model.timesShown(model.columnNear(256)), 1);
    }
}

// Moving to and fro over a border makes nothing again.
TEST(TileTable, CirclingABorderMakesNothingNew) {
    Model model(5);
    const auto circle = [&] {
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            model.moveTo(viewAt(64 + x, -64 + y));
            model.finishAll();
        }
    };
    circle();
    circle();
    const int made = model.made();
    circle();
    EXPECT_EQ(model.made(), made);
}

// A stale tile stays on screen until it has been made again, once.
TEST(TileTable, AStaleTileIsMadeAgain) {
    Model model(7);
    model.moveTo(viewAt(0, 0));
    model.finishAll();
    const std::set<ChunkPos> shown = model.shown();
    const int made = model.made();
    model.outdate(3);
    EXPECT_EQ(missingTiles(model.table()), 3u);
    EXPECT_EQ(model.shown(), shown);
    model.finishAll();
    EXPECT_EQ(model.made(), made + 3);
    EXPECT_EQ(model.shown(), shown);
}

// A change while a tile is made comes too late for it.
TEST(TileTable, ATileThatBecomesStaleWhileItIsMadeIsMadeTwice) {
    TileTable table;
    setTileView(table, {{0, 0}, 4, 64, 8});
    updateTiles(table);
    const ChunkPos tile = popTileRequests(table, 1).front();
    invalidateTile(table, tile);
    finishTile(table, tile);
    EXPECT_EQ(updateTiles(table).shown, std::vector{tile});
    const std::vector<ChunkPos> again = popTileRequests(table, 1000);
    EXPECT_EQ(std::ranges::count(again, tile), 1);
    finishTile(table, tile);
    updateTiles(table);
    EXPECT_EQ(std::ranges::count(popTileRequests(table, 1000), tile), 0);
}

TEST(TileTable, TellsWhatIsShown) {
    Model model(8);
    model.moveTo({{0, 0}, 4, 0, 8});
    model.finishAll();
    EXPECT_EQ(shownLevels(model.table()), "");
    model.moveTo({{0, 0}, 4, 16, 8});
    model.finishAll();
    EXPECT_THAT(shownLevels(model.table()), testing::MatchesRegex("[1-9][0-9]+ [1-9][0-9]+ [0-9]+ [0-9]+"));
}

TEST(TileTable, TellsThatSomethingShownIsGone) {
    TileTable table;
    setTileView(table, {{0, 0}, 4, 0, 8});
    setChunkReady(table, {1, 1}, true);
    setChunkReady(table, {1, 1}, false);
    EXPECT_FALSE(table.hasGone) << "it was not shown yet";
    setChunkReady(table, {1, 1}, true);
    EXPECT_EQ(updateTiles(table).shown.size(), 1u);
    setChunkReady(table, {1, 1}, false);
    EXPECT_TRUE(table.hasGone);
    EXPECT_EQ(updateTiles(table).hidden.size(), 1u);
    EXPECT_FALSE(table.hasGone);
}

// At the edge of the world there is nothing beyond it.
TEST(TileTable, TheWorldEnds) {
    Model model(6);
    model.moveTo({{world::kMaxChunk - 3, world::kMinChunk + 2}, 8, 128, 8});
    for (int k = 0; k < 3; ++k) model.work(0, 2000);
    EXPECT_FALSE(model.shown().empty());
    for (const ChunkPos pos : model.shown()) EXPECT_TRUE(world::isInWorld(pos));
}

}  // namespace
}  // namespace terrane::stream
