// Tiles for tests of derived rows: a tile of level 1 or 2 holds a hash of each of its four children. A chunk
// whose block 0 is air counts as none, and a tile without children does not exist.
#pragma once

#include <cstring>
#include <map>
#include <memory>
#include <set>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/derived_rows.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {

inline constexpr int kTopTileLevel = 2;
using TileMap = std::map<world::ChunkPos, world::ChunkPtr>;

inline world::ChunkPos tileAbove(world::ChunkPos pos) {
    return {pos.x >> 1, pos.y >> 1, static_cast<std::uint8_t>(pos.level + 1)};
}

// FNV-1a of the saved bytes; 0: none.
inline std::uint64_t sumOf(const world::ChunkPtr& chunk) {
    if (!chunk || chunk->block(0) == world::kAir) return 0;
    static const BlockIdMap ids = *BlockIdMap::make(testRegistry(), {});
    std::uint64_t sum = 0xCBF2'9CE4'8422'2325;
    const Bytes bytes = *encodeChunk(*chunk, ids);
    for (const std::byte byte : bytes) sum = (sum ^ static_cast<std::uint64_t>(byte)) * 0x100'0000'01B3;
    return sum;
}

template <class Lookup>
world::ChunkPtr tileOf(world::ChunkPos pos, const Lookup& childAt) {
    std::array<std::uint64_t, 4> sums;
    for (int k = 0; k < 4; ++k)
        sums[static_cast<std::size_t>(k)] = sumOf(childAt(
            world::ChunkPos{pos.x * 2 + k % 2, pos.y * 2 + k / 2, static_cast<std::uint8_t>(pos.level - 1)}));
    if (sums == std::array<std::uint64_t, 4>{}) return nullptr;
    auto tile = std::make_shared<world::Chunk>();
    tile->setBlock(0, 1);
    for (std::size_t k = 0; k < 4; ++k)
        tile->setBlock(static_cast<world::BlockIndex>(k + 1), static_cast<world::BlockId>(sums[k] % 4));
    world::BlockEntityData data(sizeof sums);
    std::memcpy(data.data(), sums.data(), sizeof sums);
    tile->setBlockEntityData(100, std::move(data));
    return tile;
}

inline std::vector<ChunkRow> deriveSums(std::span<const ChunkRow> edited, const ReadEdited& saved) {
    TileMap known;
    std::set<world::ChunkPos> changed;
    for (const ChunkRow& row : edited) {
        known[row.pos] = row.chunk;
        changed.insert(row.pos);
    }
    const auto chunkAt = [&](world::ChunkPos pos) {
        const auto found = known.find(pos);
        return found == known.end() ? saved(pos) : found->second;
    };
    std::vector<ChunkRow> tiles;
    for (int level = 1; level <= kTopTileLevel; ++level) {
        std::set<world::ChunkPos> above;
        for (const world::ChunkPos pos : changed) above.insert(tileAbove(pos));
        for (const world::ChunkPos pos : above) tiles.push_back({pos, known[pos] = tileOf(pos, chunkAt)});
        changed = std::move(above);
    }
    return tiles;
}

// All tiles of a world with these edited chunks.
inline TileMap tilesOf(std::span<const ChunkRow> edited) {
    TileMap tiles;
    for (ChunkRow& row : deriveSums(edited, [](world::ChunkPos) { return nullptr; }))
        if (row.chunk) tiles.emplace(row.pos, std::move(row.chunk));
    return tiles;
}

}  // namespace terrane::store
