// Helpers for tests of generated land: generators, areas of chunks, block ids.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/generators/catalogue.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {

inline Generator generatorOf(std::string_view name, std::uint64_t seed, int level = 0) {
    auto graph = makeGenerator(name, contentBlocks(), level);
    EXPECT_TRUE(graph.has_value()) << (graph ? "" : graph.error().message);
    return Generator(std::move(*graph), seed);
}

inline Generator overworld(std::uint64_t seed) {
    return generatorOf("overworld", seed);
}

inline BlockId idOf(std::string_view name) {
    const world::BlockType* type = contentBlocks().find(name);
    EXPECT_NE(type, nullptr) << name;
    return type ? type->id : contentBlocks().missing();
}

inline bool isOpaqueCube(BlockId block) {
    return contentBlocks().type(block).opaqueCube;
}

// A square of chunks; x and y from its corner.
class Area {
  public:
    Area(const Generator& generator, ChunkPos corner, int chunks)
        : corner_(corner), side_(chunks), heights_(generator.heights()) {
        for (int k = 0; k < chunks * chunks; ++k) {
            chunks_.push_back(blocksOf(generator.generate({corner.x + k % chunks, corner.y + k / chunks})));
        }
    }

    int blocks() const { return side_ * world::kChunkSize; }
    world::Heights heights() const { return heights_; }

    BlockId at(int x, int y, int z) const {
        const auto chunk = static_cast<std::size_t>(x / 16 + y / 16 * side_);
        return chunks_[chunk][world::blockIndex(x % 16, y % 16, z - heights_.bottom)];
    }

    // The highest ground of a column, under water and trees.
    int groundHeight(int x, int y) const {
        int z = heights_.top - 1;
        while (z > heights_.bottom && (at(x, y, z) == log_ || !isOpaqueCube(at(x, y, z)))) --z;
        return z;
    }

    std::string where(int x, int y, int z) const {
        return "at (" + std::to_string(corner_.x * 16 + x) + ", " + std::to_string(corner_.y * 16 + y) +
               ", " + std::to_string(z) + "): " + contentBlocks().type(at(x, y, z)).name;
    }

  private:
    ChunkPos corner_;
    int side_;
    world::Heights heights_;
    BlockId log_ = idOf("oak_log");
    std::vector<std::vector<BlockId>> chunks_;
};

}  // namespace terrane::gen
