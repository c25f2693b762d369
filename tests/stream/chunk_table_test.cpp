// The rules of streaming with a clock and workers of the test's own.
#include "terrane/stream/chunk_table.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace terrane::stream {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using world::ChunkPos;

class ChunkTableTest : public testing::Test {
  protected:
    static constexpr std::size_t kAll = 100000;

    // Does everything there is to do.
    void settle() {
        for (;;) {
            const auto loads = table_.takeLoads(kAll);
            for (const ChunkPos pos : loads) table_.loaded(pos, now_);
            const auto finishes = table_.takeFinishes(kAll);
            for (const ChunkPos pos : finishes) table_.finished(pos);
            if (loads.empty() && finishes.empty()) return;
        }
    }

    ChunkTable table_;
    ChunkTable::Time now_{};
};

TEST_F(ChunkTableTest, TheNearestComeFirst) {
    table_.setView({10, 20}, 3);
    const auto loads = table_.takeLoads(9);
    ASSERT_EQ(loads.size(), 9u);
    EXPECT_EQ(loads[0], (ChunkPos{10, 20}));
    for (const ChunkPos pos : loads) EXPECT_LE(world::chunkDistance(pos, {10, 20}), 1);
    EXPECT_EQ(table_.takeLoads(kAll).size(), 81u - 9u) << "the view and one ring around it";
    EXPECT_TRUE(table_.takeLoads(kAll).empty());
}

TEST_F(ChunkTableTest, WhatLiesInFrontComesBeforeWhatLiesBehind) {
    table_.setView({0, 0}, 6, {1, 0});
    const auto loads = table_.takeLoads(kAll);
    const auto rank = [&](ChunkPos pos) {
        return std::find(loads.begin(), loads.end(), pos) - loads.begin();
    };
    EXPECT_LT(rank({4, 0}), rank({-4, 0}));
    EXPECT_LT(rank({5, 1}), rank({-4, -1}));
    EXPECT_LT(rank({-1, 0}), rank({5, 0})) << "but what is near comes first";
}

TEST_F(ChunkTableTest, AChunkIsFinishedOnceItsNeighboursAreActive) {
    table_.setView({0, 0}, 0);
    const auto loads = table_.takeLoads(kAll);
    ASSERT_EQ(loads.size(), 9u);
    for (std::size_t k = 0; k < 8; ++k) {
        table_.loaded(loads[k], now_);
        EXPECT_TRUE(table_.takeFinishes(kAll).empty());
    }
    table_.loaded(loads[8], now_);
    EXPECT_EQ(table_.takeFinishes(kAll), std::vector<ChunkPos>{ChunkPos{}});
    EXPECT_TRUE(table_.finished({0, 0}));
    EXPECT_TRUE(table_.is({0, 0}, ChunkStage::Visible));
    EXPECT_EQ(table_.visibleInView(), 1u);
}

TEST_F(ChunkTableTest, AtTheCornerOfTheWorldWhatIsBeyondIsNotWaitedFor) {
    table_.setView({world::kMaxChunk, world::kMaxChunk}, 1);
    settle();
    EXPECT_EQ(table_.wantedVisible(), 4u);
    EXPECT_EQ(table_.visibleInView(), 4u);
    EXPECT_EQ(table_.size(), 9u);
}

TEST_F(ChunkTableTest, ChangesMakeResultsOnTheWayOld) {
    table_.setView({0, 0}, 1);
    for (const ChunkPos pos : table_.takeLoads(kAll)) table_.loaded(pos, now_);
    ASSERT_EQ(table_.takeFinishes(kAll).size(), 9u);
    table_.blocksChanged({2, 0});
    EXPECT_FALSE(table_.finished({1, 0}));
    EXPECT_TRUE(table_.finished({0, 0})) << "two chunks away";
    EXPECT_EQ(table_.takeFinishes(kAll), (std::vector<ChunkPos>{{1, 0}})) << "it is made again";
    EXPECT_TRUE(table_.finished({1, 0}));
}

TEST_F(ChunkTableTest, AChangeBeforeAChunkIsTakenDoesNotMatter) {
    table_.setView({0, 0}, 0);
    for (const ChunkPos pos : table_.takeLoads(kAll)) table_.loaded(pos, now_);
    table_.blocksChanged({0, 0});
    ASSERT_EQ(table_.takeFinishes(kAll).size(), 1u);
    EXPECT_TRUE(table_.finished({0, 0}));
}

TEST_F(ChunkTableTest, ALoadThatFailedIsTriedAgain) {
    table_.setView({0, 0}, 0);
    table_.takeLoads(kAll);
    table_.loadEnded({1, 1});
    EXPECT_EQ(table_.takeLoads(kAll), (std::vector<ChunkPos>{{1, 1}}));
}

TEST_F(ChunkTableTest, ChunksGoAfterFiveSecondsWithoutBeingAskedFor) {
    table_.setView({0, 0}, 1);
    settle();
    ASSERT_EQ(table_.size(), 25u);
    EXPECT_TRUE(table_.takeUnloads(now_ + seconds(60)).empty()) << "they are in view";
    now_ += seconds(60);
    table_.setView({100, 0}, 1);
    EXPECT_EQ(table_.takeHidden().size(), 9u);
    EXPECT_TRUE(table_.takeUnloads(now_ + milliseconds(4900)).empty());
    EXPECT_EQ(table_.takeUnloads(now_ + milliseconds(5000)).size(), 25u);
    EXPECT_EQ(table_.size(), 0u);
}

TEST_F(ChunkTableTest, OneRingOutsideTheViewAMeshStays) {
    table_.setView({0, 0}, 1);
    settle();
    table_.setView({1, 0}, 1);
    EXPECT_TRUE(table_.takeHidden().empty());
    table_.setView({2, 0}, 1);
    EXPECT_EQ(table_.takeHidden().size(), 3u);
}

TEST_F(ChunkTableTest, ARequestedChunkIsLoadedAndKept) {
    table_.setView({0, 0}, 0);
    settle();
    table_.request({50, 50}, now_);
    EXPECT_EQ(table_.takeLoads(kAll), (std::vector<ChunkPos>{{50, 50}}));
    table_.loaded({50, 50}, now_);
    table_.request({50, 50}, now_ + seconds(3));
    EXPECT_TRUE(table_.takeUnloads(now_ + seconds(7)).empty());
    EXPECT_EQ(table_.takeUnloads(now_ + seconds(8)).size(), 1u);
}

// Somebody who waits asks again every frame.
TEST_F(ChunkTableTest, WhatIsRequestedOftenIsLoadedOnce) {
    for (int frame = 0; frame < 100; ++frame) table_.request({50, 50}, now_);
    table_.request({51, 50}, now_);
    EXPECT_EQ(table_.takeLoads(kAll), (std::vector<ChunkPos>{{50, 50}, {51, 50}}));
    table_.loadEnded({50, 50});
    EXPECT_TRUE(table_.takeLoads(kAll).empty()) << "it is absent again, and nobody asks for it";
    for (int frame = 0; frame < 100; ++frame) table_.request({50, 50}, now_);
    EXPECT_EQ(table_.takeLoads(1), (std::vector<ChunkPos>{{50, 50}}));
    table_.loadEnded({50, 50});
    EXPECT_TRUE(table_.takeLoads(kAll).empty());
}

// Walks, jumps, edits, failures, results in any order: in the end everything in view is visible, what is far
// is gone, and nothing is counted twice.
TEST_F(ChunkTableTest, RandomWalksEndWellFromAnyState) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 random(seed);
        const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
        ChunkTable table;
        ChunkTable::Time now{};
        ChunkPos centre;
        int distance = 2;
        std::vector<ChunkPos> loading, finishing;
        std::set<ChunkPos> shown;
        const auto takeOne = [&](std::vector<ChunkPos>& from) {
            std::swap(from[static_cast<std::size_t>(below(static_cast<unsigned>(from.size())))], from.back());
            const ChunkPos pos = from.back();
            from.pop_back();
            return pos;
        };
        const auto step = [&](bool isWild) {
            for (const ChunkPos pos : table.takeLoads(isWild ? static_cast<std::size_t>(below(9)) : 64))
                loading.push_back(pos);
            for (const ChunkPos pos : table.takeFinishes(isWild ? static_cast<std::size_t>(below(9)) : 64))
                finishing.push_back(pos);
            for (int k = below(10); k > 0 && !loading.empty(); --k) {
                const ChunkPos pos = takeOne(loading);
                if (isWild && below(10) == 0) {
                    table.loadEnded(pos);
                } else {
                    table.loaded(pos, now);
                }
            }
            for (int k = below(10); k > 0 && !finishing.empty(); --k) {
                const ChunkPos pos = takeOne(finishing);
                const bool isShown = table.finished(pos);
                ASSERT_TRUE(!isShown || shown.insert(pos).second);
            }
            for (const ChunkPos pos : table.takeHidden()) ASSERT_EQ(shown.erase(pos), 1u);
            for (const ChunkPos pos : table.takeUnloads(now)) ASSERT_FALSE(shown.contains(pos));
            ASSERT_EQ(table.loadingCount(), loading.size());
            ASSERT_EQ(table.finishingCount(), finishing.size());
            now += milliseconds(below(200));
        };
        for (int k = 0; k < 400; ++k) {
            if (below(5) == 0) centre = {centre.x + below(3) - 1, centre.y + below(3) - 1};
            if (below(100) == 0) centre.x += 500;
            if (below(60) == 0) distance = below(4);
            table.setView(centre, distance, below(2) == 0 ? glm::vec2{0, 1} : glm::vec2{});
            if (below(4) == 0) table.blocksChanged({centre.x + below(7) - 3, centre.y + below(7) - 3});
            if (below(20) == 0) table.request({centre.x + below(40) - 20, centre.y}, now);
            ASSERT_NO_FATAL_FAILURE(step(true));
        }
        for (int k = 0; k < 300; ++k) ASSERT_NO_FATAL_FAILURE(step(false));
        EXPECT_EQ(table.visibleInView(), table.wantedVisible()) << "seed " << seed;
        const std::size_t side = 2 * static_cast<std::size_t>(distance) + 3;
        EXPECT_EQ(table.size(), side * side) << "what is far is gone";
        std::size_t inView = 0;
        for (const ChunkPos pos : shown) inView += world::chunkDistance(pos, centre) <= distance ? 1 : 0;
        EXPECT_EQ(inView, table.visibleInView());
    }
}

}  // namespace
}  // namespace terrane::stream
