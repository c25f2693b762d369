// Tests of BatchGenerator that every back end must pass, compared with gen::Generator.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include "terrane/gen/batch_generator.h"

namespace terrane::gen {

inline std::vector<world::ChunkPos> chunksInSquare(world::ChunkPos first, int size) {
    std::vector<world::ChunkPos> chunks;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) chunks.push_back(world::offsetBy(first, x, y));
    }
    return chunks;
}

// More chunks than all batches in flight hold.
inline void expectAllGenerated(BatchGenerator& batches, const Generator& expected) {
    const std::vector<world::ChunkPos> positions = chunksInSquare({-9, 4}, 15);
    const auto chunks = generateAll(batches, positions);
    ASSERT_TRUE(chunks) << chunks.error().message;
    ASSERT_EQ(chunks->size(), positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k) {
        ASSERT_TRUE(*(*chunks)[k] == expected.generate(positions[k]))
            << positions[k].x << "," << positions[k].y;
    }
    EXPECT_TRUE(generateAll(batches, {})->empty());
}

// Polls without waiting, as a frame does.
inline void expectBatchesInOrder(BatchGenerator& batches, const Generator& expected) {
    const std::vector<world::ChunkPos> positions = chunksInSquare({30, -7}, 7);
    EXPECT_TRUE(batches.take(false).empty());
    EXPECT_TRUE(batches.take(true).empty()) << "nothing is in flight";
    EXPECT_EQ(batches.submit({}), 0u);
    std::size_t submitted = 0, taken = 0;
    for (std::size_t size = 1;; ++size) {
        const std::size_t count = std::min(size, positions.size() - submitted);
        if (count == 0) break;
        const std::size_t accepted = batches.submit(std::span(positions).subspan(submitted, count));
        ASSERT_LE(accepted, count);
        submitted += accepted;
        if (accepted == 0) break;
    }
    EXPECT_GE(submitted, 3u) << "two batches can be in flight";
    while (taken < submitted) {
        for (const GeneratedChunk& done : batches.take(false)) {
            ASSERT_EQ(done.pos, positions[taken++]);
            ASSERT_TRUE(*done.chunk == expected.generate(done.pos));
            EXPECT_EQ(done.chunk.use_count(), 1);
        }
    }
    EXPECT_EQ(taken, submitted);
}

// Chunks of another level and chunks outside the world are refused.
inline void expectOthersRefused(BatchGenerator& batches) {
    for (const world::ChunkPos refused :
         {world::ChunkPos{3, 4, 2}, {world::kMaxChunk + 1, 0}, {0, world::kMinChunk - 1}}) {
        const std::vector<world::ChunkPos> positions = {{3, 4}, refused};
        EXPECT_THROW(static_cast<void>(batches.submit(positions)), std::invalid_argument);
        EXPECT_FALSE(generateAll(batches, positions));
        EXPECT_TRUE(batches.take(true).empty()) << "none of them is taken";
    }
    const std::vector<world::ChunkPos> coarse = {{3, -4, 2}};
    EXPECT_EQ(generateAll(batches, coarse).error().message,
              "chunk 3,-4 of level 2: this generator makes level 0 only");
}

inline void expectBatchGeneratorCases(BatchGenerator& batches, const Generator& expected) {
    expectAllGenerated(batches, expected);
    expectBatchesInOrder(batches, expected);
    expectOthersRefused(batches);
    expectAllGenerated(batches, expected);
}

}  // namespace terrane::gen
