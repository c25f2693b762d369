#include "terrane/light_gpu/light_workspace_internal.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "tests/light/batch_lighter_cases.h"

namespace terrane::light_gpu {
namespace {

using light::LightRequest;
using world::ChunkPos;
using world::ChunkPtr;

// A world of equal chunks; each is an object of its own.
class Chunks {
  public:
    explicit Chunks(ChunkPos low, ChunkPos high) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) chunks_[{x, y}] = std::make_shared<world::Chunk>();
        }
    }
    ChunkPtr& at(ChunkPos pos) { return chunks_.at(pos); }
    LightRequest request(ChunkPos pos) const {
        LightRequest request{pos, {}};
        for (int n = 0; n < light::kFieldChunks; ++n) {
            const auto found = chunks_.find(world::offsetBy(pos, n % 3 - 1, n / 3 - 1));
            if (found != chunks_.end()) request.chunks[static_cast<std::size_t>(n)] = found->second;
        }
        return request;
    }
    std::vector<LightRequest> square(ChunkPos first, int size) const {
        std::vector<LightRequest> requests;
        for (int k = 0; k < size * size; ++k)
            requests.push_back(request(world::offsetBy(first, k % size, k / size)));
        return requests;
    }

  private:
    std::map<ChunkPos, ChunkPtr> chunks_;
};

TEST(LightBatch, ASquareSharesItsNeighbors) {
    const Chunks chunks({-20, -20}, {20, 20});
    const LightBatch batch = gatherBatch(chunks.square({-3, 5}, 8), light::contentTable());
    EXPECT_EQ(batch.requested.size(), 64u);
    EXPECT_EQ(batch.chunks.size(), 100u);
    EXPECT_EQ(batch.requested[9], (ChunkPos{-2, 6}));
    EXPECT_EQ(std::set(batch.chunks.begin(), batch.chunks.end()).size(), 100u) << "each chunk once";
    const shared::uvec4 beside = batch.beside[9];
    EXPECT_EQ(beside, shared::uvec4(8, 10, 1, 17));
    const LightBatch most = gatherBatch(chunks.square({-8, -8}, 16), light::contentTable());
    EXPECT_EQ(most.requested.size(), kMaxRequests);
    EXPECT_EQ(most.chunks.size(), kMaxSolved);
}

TEST(LightBatch, ChunksThatAreNotThereHaveNoNumber) {
    const Chunks chunks({0, 0}, {1, 0});
    const std::vector<LightRequest> requests = {chunks.request({1, 0})};
    const LightBatch batch = gatherBatch(requests, light::contentTable());
    ASSERT_EQ(batch.chunks.size(), 2u);
    EXPECT_EQ(batch.chunks[0], requests[0].chunks[light::kCenterChunk]);
    EXPECT_EQ(batch.beside[0], shared::uvec4(1, shared::kNoChunk, shared::kNoChunk, shared::kNoChunk));
    EXPECT_EQ(batch.beside[1], shared::uvec4(shared::kNoChunk, 0, shared::kNoChunk, shared::kNoChunk));
}

TEST(LightBatch, TakesAsManyAsThereIsRoomFor) {
    const Chunks chunks({-2, -2}, {300, 2});
    std::vector<LightRequest> apart;
    for (int k = 0; k < 60; ++k) apart.push_back(chunks.request({4 * k, 0}));
    const LightBatch batch = gatherBatch(apart, light::contentTable());
    EXPECT_EQ(batch.requested.size(), kMaxSolved / 9);
    EXPECT_EQ(batch.chunks.size(), kMaxSolved);
}

TEST(LightBatch, EndsWhereSnapshotsDiffer) {
    Chunks chunks({-2, -2}, {9, 2});
    std::vector<LightRequest> requests = {chunks.request({0, 0}), chunks.request({5, 0})};
    chunks.at({1, 1}) = std::make_shared<world::Chunk>();
    requests.push_back(chunks.request({6, 0}));  // does not see it
    requests.push_back(chunks.request({2, 0}));
    EXPECT_EQ(gatherBatch(requests, light::contentTable()).requested.size(), 3u);
    requests[3] = requests[0];
    EXPECT_EQ(gatherBatch(requests, light::contentTable()).requested.size(), 3u) << "the same chunk twice";
    requests[3] = chunks.request({2, 2});
    requests[3].chunks[0] = nullptr;  // 1,1, which the first one has
    EXPECT_EQ(gatherBatch(requests, light::contentTable()).requested.size(), 3u);
}

// The numbers of the sections that are solved for one chunk alone.
std::vector<int> solvedSections(world::Heights heights, const light::TestArea::Source& source) {
    const std::vector<LightRequest> requests = light::RequestArea(1, 1, source, {0, 0}, heights).all();
    return gatherBatch(requests, light::contentTable()).sections;
}

TEST(LightBatch, SkyAndRockAreNotSolved) {
    const world::Heights tall{-2048, 2048};
    const world::BlockId stone = contentBlock("stone"), lamp = contentBlock("lamp_red"),
                         water = contentBlock("water");
    using Numbers = std::vector<int>;
    EXPECT_EQ(solvedSections(tall, [](int, int, int) { return world::kAir; }), Numbers{-128});
    EXPECT_EQ(solvedSections(tall, [&](int, int, int) { return stone; }), Numbers{127});
    EXPECT_EQ(solvedSections(tall, [&](int, int, int z) { return z < 0 ? stone : world::kAir; }), Numbers{0});
    EXPECT_EQ(solvedSections(tall, [&](int, int, int z) { return z < 1 ? stone : world::kAir; }),
              (Numbers{0, 1}));
    EXPECT_EQ(solvedSections(tall, [&](int, int, int z) { return z < 0 ? lamp : world::kAir; }).size(), 129u);
    EXPECT_EQ(solvedSections({0, 64}, [&](int, int, int) { return water; }), (Numbers{0, 1, 2, 3}));
    // A cave in rock, under sky: one section of rock parts them.
    EXPECT_EQ(
        solvedSections(
            tall, [&](int, int, int z) { return z >= 512 || (z >= -512 && z < -490) ? world::kAir : stone; }),
        (Numbers{-32, -31, 31, 32}));
    // A roof over everything.
    EXPECT_EQ(solvedSections({0, 128}, [&](int, int, int z) { return z < 64 ? world::kAir : stone; }),
              (Numbers{0, 1, 2, 3, 7}));
}

TEST(LightBatch, OneChunksContentIsSolvedInAll) {
    const light::TestArea::Source source = [](int x, int, int z) {
        return x == 0 && z == 500 ? contentBlock("stone") : z < 100 ? contentBlock("stone") : world::kAir;
    };
    const std::vector<LightRequest> requests = light::RequestArea(3, 1, source, {0, 0}, {-1024, 1024}).all();
    const LightBatch batch = gatherBatch(requests, light::contentTable());
    EXPECT_EQ(batch.requested.size(), 3u);
    EXPECT_EQ(batch.sections.front(), 6);
    EXPECT_EQ(batch.sections.back(), 32);
}

TEST(LightBatch, TakesFewerChunksWhereMoreIsSolved) {
    const light::TallWorld world = light::tallWorld(3);
    const std::vector<LightRequest> requests = light::RequestArea(7, 6, world, {0, 0}, world.heights).all();
    const LightBatch batch = gatherBatch(requests, light::contentTable());
    EXPECT_LT(batch.requested.size(), requests.size());
    EXPECT_GT(batch.requested.size(), 0u);
    EXPECT_LE(batch.chunks.size() * batch.sections.size(), kMaxSolvedSections);
}

TEST(LightBatch, ChunksHaveTheSameHeights) {
    std::vector<LightRequest> requests(1);
    requests[0].chunks[light::kCenterChunk] = std::make_shared<world::Chunk>();
    requests[0].chunks[0] = std::make_shared<world::Chunk>(world::Heights{-64, 256});
    EXPECT_THROW(gatherBatch(requests, light::contentTable()), std::invalid_argument);
}

TEST(LightBatch, NeedsTheChunkToLight) {
    const std::vector<LightRequest> requests(1);  // without chunks
    EXPECT_THROW(gatherBatch(requests, light::contentTable()), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::light_gpu
