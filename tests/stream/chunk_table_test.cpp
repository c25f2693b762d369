// The rules of streaming, with the test's own clock and workers.
#include "terrane/stream/chunk_table.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "terrane/stream/lighting.h"
#include "terrane/stream/meshing.h"
#include "terrane/stream/residency.h"

namespace terrane::stream {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using world::ChunkPos;

std::vector<ChunkPos> unloadAll(ChunkTable& table, Time now) {
    const std::vector<ChunkPos> unneeded = findUnneeded(table, now);
    for (const ChunkPos pos : unneeded) unload(table, pos);
    return unneeded;
}

class ChunkTableTest : public testing::Test {
  protected:
    static constexpr std::size_t kAll = 100000;

    // Does all work that there is.
    void settle() {
        for (;;) {
            const auto loads = popLoadRequests(table_, kAll);
            for (const ChunkPos pos : loads) finishLoad(table_, pos, now_);
            const auto finishes = popLightingRequests(table_, kAll);
            for (const ChunkPos pos : finishes) finishLighting(table_, pos);
            if (loads.empty() && finishes.empty()) return;
        }
    }

    ChunkTable table_;
    Time now_{};
};

TEST_F(ChunkTableTest, TheNearestComeFirst) {
    setView(table_, {10, 20}, 3);
    const auto loads = popLoadRequests(table_, 9);
    ASSERT_EQ(loads.size(), 9u);
    EXPECT_EQ(loads[0], (ChunkPos{10, 20}));
    for (const ChunkPos pos : loads) EXPECT_LE(world::chunkDistance(pos, {10, 20}), 1);
    EXPECT_EQ(popLoadRequests(table_, kAll).size(), 81u - 9u) << "the view and one ring around it";
    EXPECT_TRUE(popLoadRequests(table_, kAll).empty());
}

TEST_F(ChunkTableTest, WhatLiesInFrontComesBeforeWhatLiesBehind) {
    setView(table_, {0, 0}, 6, {1, 0});
    const auto loads = popLoadRequests(table_, kAll);
    const auto rank = [&](ChunkPos pos) {
        return std::find(loads.begin(), loads.end(), pos) - loads.begin();
    };
    EXPECT_LT(rank({4, 0}), rank({-4, 0}));
    EXPECT_LT(rank({5, 1}), rank({-4, -1}));
    EXPECT_LT(rank({-1, 0}), rank({5, 0})) << "but what is near comes first";
}

TEST_F(ChunkTableTest, AChunkIsFinishedOnceItsNeighborsAreActive) {
    setView(table_, {0, 0}, 0);
    const auto loads = popLoadRequests(table_, kAll);
    ASSERT_EQ(loads.size(), 9u);
    for (std::size_t k = 0; k < 8; ++k) {
        finishLoad(table_, loads[k], now_);
        EXPECT_TRUE(popLightingRequests(table_, kAll).empty());
    }
    finishLoad(table_, loads[8], now_);
    EXPECT_EQ(popLightingRequests(table_, kAll), std::vector<ChunkPos>{ChunkPos{}});
    EXPECT_TRUE(finishLighting(table_, {0, 0}));
    EXPECT_TRUE(isAt(table_, {0, 0}, ChunkStage::Visible));
    EXPECT_EQ(table_.visibleInView, 1u);
}

TEST_F(ChunkTableTest, AtTheCornerOfTheWorldWhatIsBeyondIsNotWaitedFor) {
    setView(table_, {world::kMaxChunk, world::kMaxChunk}, 1);
    settle();
    EXPECT_EQ(table_.chunksInView, 4u);
    EXPECT_EQ(table_.visibleInView, 4u);
    EXPECT_EQ(table_.records.size(), 9u);
}

TEST_F(ChunkTableTest, ChangesMakeResultsOnTheWayOld) {
    setView(table_, {0, 0}, 1);
    for (const ChunkPos pos : popLoadRequests(table_, kAll)) finishLoad(table_, pos, now_);
    ASSERT_EQ(popLightingRequests(table_, kAll).size(), 9u);
    invalidateLighting(table_, {2, 0});
    EXPECT_FALSE(finishLighting(table_, {1, 0}));
    EXPECT_TRUE(finishLighting(table_, {0, 0})) << "two chunks away";
    EXPECT_EQ(popLightingRequests(table_, kAll), (std::vector<ChunkPos>{{1, 0}})) << "it is made again";
    EXPECT_TRUE(finishLighting(table_, {1, 0}));
}

TEST_F(ChunkTableTest, AChangeBeforeAChunkIsTakenDoesNotMatter) {
    setView(table_, {0, 0}, 0);
    for (const ChunkPos pos : popLoadRequests(table_, kAll)) finishLoad(table_, pos, now_);
    invalidateLighting(table_, {0, 0});
    ASSERT_EQ(popLightingRequests(table_, kAll).size(), 1u);
    EXPECT_TRUE(finishLighting(table_, {0, 0}));
}

TEST_F(ChunkTableTest, ALoadThatFailedIsTriedAgain) {
    setView(table_, {0, 0}, 0);
    popLoadRequests(table_, kAll);
    abandonLoad(table_, {1, 1});
    EXPECT_EQ(popLoadRequests(table_, kAll), (std::vector<ChunkPos>{{1, 1}}));
}

TEST_F(ChunkTableTest, ChunksGoAfterFiveSecondsWithoutBeingAskedFor) {
    setView(table_, {0, 0}, 1);
    settle();
    ASSERT_EQ(table_.records.size(), 25u);
    EXPECT_TRUE(unloadAll(table_, now_ + seconds(60)).empty()) << "they are in view";
    now_ += seconds(60);
    setView(table_, {100, 0}, 1);
    EXPECT_EQ(popHidden(table_).size(), 9u);
    EXPECT_TRUE(unloadAll(table_, now_ + milliseconds(4900)).empty());
    EXPECT_EQ(unloadAll(table_, now_ + milliseconds(5000)).size(), 25u);
    EXPECT_EQ(table_.records.size(), 0u);
}

TEST_F(ChunkTableTest, OneRingOutsideTheViewAMeshStays) {
    setView(table_, {0, 0}, 1);
    settle();
    setView(table_, {1, 0}, 1);
    EXPECT_TRUE(popHidden(table_).empty());
    setView(table_, {2, 0}, 1);
    EXPECT_EQ(popHidden(table_).size(), 3u);
}

TEST_F(ChunkTableTest, ARequestedChunkIsLoadedAndKept) {
    setView(table_, {0, 0}, 0);
    settle();
    requestChunk(table_, {50, 50}, now_);
    EXPECT_EQ(popLoadRequests(table_, kAll), (std::vector<ChunkPos>{{50, 50}}));
    finishLoad(table_, {50, 50}, now_);
    requestChunk(table_, {50, 50}, now_ + seconds(3));
    EXPECT_TRUE(unloadAll(table_, now_ + seconds(7)).empty());
    EXPECT_EQ(unloadAll(table_, now_ + seconds(8)).size(), 1u);
}

// A waiting caller requests the chunk every frame.
TEST_F(ChunkTableTest, WhatIsRequestedOftenIsLoadedOnce) {
    for (int frame = 0; frame < 100; ++frame) requestChunk(table_, {50, 50}, now_);
    requestChunk(table_, {51, 50}, now_);
    EXPECT_EQ(popLoadRequests(table_, kAll), (std::vector<ChunkPos>{{50, 50}, {51, 50}}));
    abandonLoad(table_, {50, 50});
    EXPECT_TRUE(popLoadRequests(table_, kAll).empty()) << "it is absent again, and nobody asks for it";
    for (int frame = 0; frame < 100; ++frame) requestChunk(table_, {50, 50}, now_);
    EXPECT_EQ(popLoadRequests(table_, 1), (std::vector<ChunkPos>{{50, 50}}));
    abandonLoad(table_, {50, 50});
    EXPECT_TRUE(popLoadRequests(table_, kAll).empty());
}

mesh::MeshSectionSet meshSections(std::initializer_list<int> numbers) {
    mesh::MeshSectionSet set;
    for (const int number : numbers) set.add(number);
    return set;
}

TEST_F(ChunkTableTest, WholeChunksAreMeshedAgainByJobsAndEditsAtOnce) {
    setView(table_, {0, 0}, 1);
    settle();
    requestWholeMesh(table_, {0, 0});
    requestWholeMesh(table_, {1, 0});
    requestEditedMesh(table_, {1, 0}, meshSections({1}));
    requestEditedMesh(table_, {-1, 0}, meshSections({-200}));
    requestEditedMesh(table_, {-1, 0}, meshSections({0}));
    requestEditedMesh(table_, {40, 0}, meshSections({0}));
    const auto edited = popEditedMeshes(table_, kAll);
    ASSERT_EQ(edited.size(), 2u) << "absent chunks are passed over";
    EXPECT_EQ(edited[0].meshSections, mesh::kAllMeshSections) << "all of it had to be meshed";
    EXPECT_EQ(edited[1].meshSections, meshSections({0, -200}));
    const auto jobs = popMeshJobs(table_, kAll);
    ASSERT_EQ(jobs.size(), 1u);
    EXPECT_EQ(jobs[0].pos, (ChunkPos{0, 0}));
    EXPECT_EQ(pendingMeshes(table_), 1u);
    EXPECT_TRUE(finishMeshJob(table_, jobs[0]));
    EXPECT_EQ(pendingMeshes(table_), 0u);
}

TEST_F(ChunkTableTest, AnEditOutdatesTheJobThatMeshesTheChunk) {
    setView(table_, {0, 0}, 1);
    settle();
    requestWholeMesh(table_, {0, 0});
    const auto jobs = popMeshJobs(table_, kAll);
    requestEditedMesh(table_, {0, 0}, meshSections({1}));
    EXPECT_EQ(popEditedMeshes(table_, kAll)[0].meshSections, mesh::kAllMeshSections);
    EXPECT_FALSE(finishMeshJob(table_, jobs[0]));
}

TEST_F(ChunkTableTest, AMeshJobOfAChunkThatLeftTheViewIsDropped) {
    setView(table_, {0, 0}, 1);
    settle();
    requestWholeMesh(table_, {0, 0});
    const auto jobs = popMeshJobs(table_, kAll);
    setView(table_, {100, 0}, 1);
    popHidden(table_);
    setView(table_, {0, 0}, 1);
    settle();
    EXPECT_FALSE(finishMeshJob(table_, jobs[0])) << "it was lit and meshed since";
}

// Moves, jumps, edits, failures and results in any order: in the end everything in view is visible, far
// chunks are unloaded, and nothing is counted twice.
TEST_F(ChunkTableTest, RandomWalksEndWellFromAnyState) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 random(seed);
        const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
        ChunkTable table;
        Time now{};
        ChunkPos center;
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
            for (const ChunkPos pos :
                 popLoadRequests(table, isWild ? static_cast<std::size_t>(below(9)) : 64))
                loading.push_back(pos);
            for (const ChunkPos pos :
                 popLightingRequests(table, isWild ? static_cast<std::size_t>(below(9)) : 64))
                finishing.push_back(pos);
            for (int k = below(10); k > 0 && !loading.empty(); --k) {
                const ChunkPos pos = takeOne(loading);
                if (isWild && below(10) == 0) {
                    abandonLoad(table, pos);
                } else {
                    finishLoad(table, pos, now);
                }
            }
            for (int k = below(10); k > 0 && !finishing.empty(); --k) {
                const ChunkPos pos = takeOne(finishing);
                const bool isShown = finishLighting(table, pos);
                ASSERT_TRUE(!isShown || shown.insert(pos).second);
            }
            for (const ChunkPos pos : popHidden(table)) ASSERT_EQ(shown.erase(pos), 1u);
            for (const ChunkPos pos : unloadAll(table, now)) ASSERT_FALSE(shown.contains(pos));
            ASSERT_EQ(countOf(table, ChunkStage::Loading), loading.size());
            ASSERT_EQ(countOf(table, ChunkStage::Lighting), finishing.size());
            now += milliseconds(below(200));
        };
        for (int k = 0; k < 400; ++k) {
            if (below(5) == 0) center = {center.x + below(3) - 1, center.y + below(3) - 1};
            if (below(100) == 0) center.x += 500;
            if (below(60) == 0) distance = below(4);
            setView(table, center, distance, below(2) == 0 ? glm::vec2{0, 1} : glm::vec2{});
            if (below(4) == 0) invalidateLighting(table, {center.x + below(7) - 3, center.y + below(7) - 3});
            if (below(20) == 0) requestChunk(table, {center.x + below(40) - 20, center.y}, now);
            ASSERT_NO_FATAL_FAILURE(step(true));
        }
        for (int k = 0; k < 300; ++k) ASSERT_NO_FATAL_FAILURE(step(false));
        EXPECT_EQ(table.visibleInView, table.chunksInView) << "seed " << seed;
        const std::size_t side = 2 * static_cast<std::size_t>(distance) + 3;
        EXPECT_EQ(table.records.size(), side * side) << "what is far is gone";
        std::size_t inView = 0;
        for (const ChunkPos pos : shown) inView += world::chunkDistance(pos, center) <= distance ? 1 : 0;
        EXPECT_EQ(inView, table.visibleInView);
    }
}

}  // namespace
}  // namespace terrane::stream
