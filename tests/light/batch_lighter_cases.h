// Requirements on every back end of BatchLighter, tested against lightChunk.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "terrane/light/batch_lighter.h"
#include "tests/light/reference_light.h"
#include "tests/light/tall_worlds.h"
#include "tests/light/test_area.h"
#include "tests/support/default_heights.h"

namespace terrane::light {

// Reference: light of the chunk by definition.
inline ChunkLight directLight(const LightRequest& request) {
    LightScratch scratch;
    std::array<LocalLight, kFieldChunks> locals;
    LocalLightNeighborhood around{};
    for (std::size_t n = 0; n < locals.size(); ++n) {
        if (!request.chunks[n]) continue;
        locals[n] = solveLocal(*request.chunks[n], contentTable(), scratch);
        around[n] = &locals[n];
    }
    return lightChunk(around, scratch);
}

// Chunks of a world whose corner chunk is `corner`. Nothing is known around them.
class RequestArea {
  public:
    RequestArea(int sizeX, int sizeY, const TestArea::Source& source, world::ChunkPos corner = {-1, 2},
                world::Heights heights = {})
        : sizeX_(sizeX), sizeY_(sizeY), corner_(corner) {
        for (world::Chunk& chunk : TestArea(sizeX, sizeY, source, heights).chunks)
            chunks_.push_back(std::make_shared<world::Chunk>(std::move(chunk)));
    }

    world::ChunkPtr& chunk(int x, int y) { return chunks_[static_cast<std::size_t>(x + sizeX_ * y)]; }
    LightRequest request(int x, int y) {
        LightRequest request{world::offsetBy(corner_, x, y), {}};
        for (int n = 0; n < kFieldChunks; ++n) {
            const int cx = x + n % kFieldSide - 1, cy = y + n / kFieldSide - 1;
            if (cx >= 0 && cy >= 0 && cx < sizeX_ && cy < sizeY_)
                request.chunks[static_cast<std::size_t>(n)] = chunk(cx, cy);
        }
        return request;
    }
    std::vector<LightRequest> all() {
        std::vector<LightRequest> requests;
        for (int k = 0; k < sizeX_ * sizeY_; ++k) requests.push_back(request(k % sizeX_, k / sizeX_));
        return requests;
    }

  private:
    int sizeX_, sizeY_;
    world::ChunkPos corner_;
    std::vector<world::ChunkPtr> chunks_;
};

inline void expectLit(BatchLighter& lighter, const std::vector<LightRequest>& requests) {
    const std::vector<ChunkLight> lights = lightAll(lighter, requests);
    ASSERT_EQ(lights.size(), requests.size());
    for (std::size_t k = 0; k < lights.size(); ++k) {
        ASSERT_TRUE(lights[k] == directLight(requests[k]))
            << "chunk " << requests[k].pos.x << "," << requests[k].pos.y;
    }
}

inline void expectRandomChunksLit(BatchLighter& lighter) {
    for (std::uint32_t seed = 20; seed < 22; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (const auto& source : {caves(seed), scattered(seed, 3), scattered(seed, 50), layers(seed)})
            expectLit(lighter, RequestArea(4, 3, source).all());
    }
    expectLit(lighter, {});
}

// Requests only some of the known chunks, apart from each other.
inline void expectScatteredRequestsLit(BatchLighter& lighter) {
    RequestArea area(7, 6, caves(30));
    std::vector<LightRequest> requests;
    for (int k = 0; k < 42; ++k) {
        if (k % 5 == 0 || k % 7 == 3) requests.push_back(area.request(k % 7, k / 7));
    }
    std::reverse(requests.begin(), requests.end());
    expectLit(lighter, requests);
    expectLit(lighter, {area.request(3, 3)});
}

// Chunks of which one, several and all neighbors are missing, at the world's corners and inside it.
inline void expectMissingNeighborsLit(BatchLighter& lighter) {
    for (const world::ChunkPos corner :
         {world::ChunkPos{world::kMinChunk, world::kMinChunk}, {world::kMaxChunk - 2, world::kMaxChunk - 1}})
        expectLit(lighter, RequestArea(3, 2, caves(40), corner).all());
    RequestArea area(3, 3, scattered(41, 40));
    std::vector<LightRequest> requests;
    for (std::size_t n = 0; n < kFieldChunks; ++n) {
        LightRequest request = area.request(1, 1);
        if (n != kCenterChunk) request.chunks[n] = nullptr;
        requests.push_back(request);
    }
    requests.push_back({{1, 1}, {}});
    requests.back().chunks[kCenterChunk] = area.chunk(1, 1);
    expectLit(lighter, requests);
}

// Each request uses its own neighbors, whatever others of the batch have at the same place.
inline void expectSnapshotsKeptApart(BatchLighter& lighter) {
    const world::BlockId lamp = contentBlock("lamp_white");
    RequestArea before(3, 1, layers(50)), after(3, 1, layers(50));
    auto edited = std::make_shared<world::Chunk>(*after.chunk(1, 0));
    for (int z = 0; z < world::kChunkHeight; z += 5) {
        edited->setBlock(world::blockIndex(0, 7, z), lamp);
        edited->setBlock(world::blockIndex(15, 7, z), lamp);
    }
    after.chunk(1, 0) = edited;
    LightRequest without = after.request(2, 0);
    without.chunks[kCenterChunk - 1] = nullptr;
    const LightRequest old = before.request(0, 0), fresh = after.request(2, 0);
    expectLit(lighter,
              {old, fresh, old, old, fresh, without, fresh, after.request(1, 0), after.request(1, 0)});
    EXPECT_FALSE(directLight(fresh) == directLight(without)) << "the neighbor's light matters here";
}

// As in a frame that never waits.
inline void expectLightInOrder(BatchLighter& lighter) {
    const std::vector<LightRequest> requests = RequestArea(5, 4, caves(60)).all();
    EXPECT_TRUE(lighter.take(false).empty());
    EXPECT_TRUE(lighter.take(true).empty()) << "nothing is in flight";
    EXPECT_EQ(lighter.submit({}), 0u);
    std::size_t submitted = 0, taken = 0, batches = 0;
    while (submitted < requests.size()) {
        const std::size_t count = std::min(batches + 1, requests.size() - submitted);
        const std::size_t accepted = lighter.submit(std::span(requests).subspan(submitted, count));
        ASSERT_LE(accepted, count);
        submitted += accepted;
        if (accepted == 0) break;
        ++batches;
    }
    EXPECT_GE(batches, 2u);
    while (taken < submitted) {
        for (const LightResult& done : lighter.take(false)) {
            ASSERT_EQ(done.pos, requests[taken].pos);
            ASSERT_TRUE(done.light == directLight(requests[taken++]));
        }
    }
}

// More requests than all batches in flight take; the lighter needs nothing of a chunk once it has taken it.
inline void expectManyRequestsLit(BatchLighter& lighter) {
    std::vector<LightRequest> requests = RequestArea(20, 10, layers(70)).all();
    const std::vector<ChunkLight> lights = lightAll(lighter, requests);
    ASSERT_EQ(lights.size(), requests.size());
    for (std::size_t k = 0; k < lights.size(); k += 7)
        ASSERT_TRUE(lights[k] == directLight(requests[k])) << k;
    RequestArea area(2, 1, caves(71));
    std::vector<LightRequest> one = {area.request(0, 0)};
    const ChunkLight expected = directLight(one[0]);
    ASSERT_EQ(lighter.submit(one), 1u);
    one.clear();
    area.chunk(0, 0) = nullptr;
    const std::vector<LightResult> found = lighter.take(true);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].light == expected);
}

// Worlds of other heights, against the formula. One chunk of some is missing, which is as if it were of
// stone.
inline void expectTallWorldsLit(BatchLighter& lighter) {
    const world::BlockId stone = contentBlock("stone");
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const TallWorld world = tallWorld(seed);
        const int missing = static_cast<int>(seed % 5);  // 4: none
        const TestArea::Source source = [&](int x, int y, int z) {
            return x / 16 + 2 * (y / 16) == missing ? stone : world(x, y, z);
        };
        RequestArea area(2, 2, source, {-1, 2}, world.heights);
        if (missing < 4) area.chunk(missing % 2, missing / 2) = nullptr;
        std::vector<LightRequest> requests;
        for (int k = 0; k < 4; ++k)
            if (k != missing) requests.push_back(area.request(k % 2, k / 2));
        std::vector<ChunkLight> lights = lightAll(lighter, requests);
        ASSERT_EQ(lights.size(), requests.size());
        if (missing < 4) lights.insert(lights.begin() + missing, ChunkLight(world.heights));
        const TestArea whole(2, 2, source, world.heights);
        expectReference(whole, whole.flatten(lights), world.heights.top);
        if (testing::Test::HasFailure()) return;
    }
}

// More chunks than fit into one batch where worlds are tall.
inline void expectManyTallChunksLit(BatchLighter& lighter) {
    const TallWorld world = tallWorld(3);
    expectLit(lighter, RequestArea(6, 6, world, {3, -4}, world.heights).all());
}

// Sections of one value at all heights: only sky, only rock, and both in several layers.
inline void expectUniformTallWorldsLit(BatchLighter& lighter) {
    const world::BlockId stone = contentBlock("stone"), lamp = contentBlock("lamp_red");
    const world::Heights heights{-2048, 2048};
    const auto slabs = [&](int x, int, int z) {
        return (z + 2048) / 512 % 2 == x / 16 ? stone : world::kAir;
    };
    const auto lampsAtEnds = [&](int x, int y, int z) {
        const bool isEnd = z == -2048 || z == 2047 || z == 15 || z == 16;
        return isEnd && x == 15 && y == 3 ? lamp : z < 16 ? stone : world::kAir;
    };
    for (const TestArea::Source& source : std::initializer_list<TestArea::Source>{
             [](int, int, int) { return world::kAir; }, [&](int, int, int) { return stone; },
             [&](int, int, int) { return lamp; },
             [&](int, int, int z) { return z < 3 ? stone : world::kAir; },
             [&](int, int, int z) { return z % 1024 == 900 ? stone : 0; }, slabs, lampsAtEnds})
        expectLit(lighter, RequestArea(2, 1, source, {0, 0}, heights).all());
}

inline void expectOtherLevelsRefused(BatchLighter& lighter) {
    std::vector<LightRequest> requests = RequestArea(2, 1, layers(80)).all();
    requests[1].pos.level = 1;
    EXPECT_THROW(static_cast<void>(lighter.submit(requests)), std::invalid_argument);
    EXPECT_TRUE(lighter.take(true).empty());
}

inline void expectLighterCases(BatchLighter& lighter) {
    expectRandomChunksLit(lighter);
    expectScatteredRequestsLit(lighter);
    expectMissingNeighborsLit(lighter);
    expectSnapshotsKeptApart(lighter);
    expectLightInOrder(lighter);
    expectManyRequestsLit(lighter);
    expectTallWorldsLit(lighter);
    expectManyTallChunksLit(lighter);
    expectUniformTallWorldsLit(lighter);
    expectOtherLevelsRefused(lighter);
}

}  // namespace terrane::light
