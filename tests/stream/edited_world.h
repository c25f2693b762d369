// Chunks that a test edits, and the tiles that follow from them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/stream/edited_tiles.h"
#include "tests/world/content_blocks.h"

namespace terrane::stream {

// Hills with grass and a lake, cheap to make.
inline base::Result<gen::GeneratorGraph> hillsOf(int level) {
    gen::GeneratorBuilder g("hills", contentBlocks(), level);
    const auto height = g.field<gen::Float>("height");
    g.pass2D("hills", [&](gen::Pass& p) { p.set(height, p.perlin2D("hills", 64, {1.0f}) * 20.0f + 60.0f); });
    g.pass3D("ground", [&](gen::Pass& p) {
        const gen::Float above = gen::Float(p.z()) - p.readAt(height, {0, 0});
        const gen::Block open = select(p.z() < 58, p.block("water"), p.block("air"));
        const gen::Block land = select(above > -1.0f, p.block("grass"), p.block("stone"));
        p.setBlock(select(above < 0.0f, land, open));
    });
    return g.finish();
}

inline gen::LevelGenerators generatorsOf(const std::string& name) {
    return {[name](int level) { return gen::makeGenerator(name, contentBlocks(), level); }, 5};
}

class EditedWorld {
  public:
    using Tiles = std::map<world::ChunkPos, world::ChunkPtr>;

    EditedWorld(const gen::LevelGenerators& generators, int topLevel)
        : generators_(generators), topLevel_(topLevel) {}

    void set(world::BlockPos pos, world::BlockId id) { chunkAt(pos).setBlock(world::blockIndex(pos), id); }
    void set(world::BlockPos pos, std::string_view name) { set(pos, contentBlock(name)); }
    void fill(const world::BlockBox& box, world::BlockId id) {
        for (std::int64_t n = 0; n < box.blockCount(); ++n) set(box.blockAt(n), id);
    }
    void fill(const world::BlockBox& box, std::string_view name) { fill(box, contentBlock(name)); }
    // Restores the generated blocks.
    void restore(const world::BlockBox& box) {
        for (std::int64_t n = 0; n < box.blockCount(); ++n) {
            const world::BlockPos pos = box.blockAt(n);
            set(pos, generated(chunkOf(pos)).block(world::blockIndex(pos)));
        }
    }
    void restoreAll() {
        for (auto& [pos, chunk] : chunks_) {
            *chunk = generated(pos);
            changed_.insert(pos);
        }
    }

    // Updates the tiles after the edits since the last call. Returns the changes.
    std::vector<TileChange> update() {
        const std::vector<world::ChunkPos> changed(changed_.begin(), changed_.end());
        changed_.clear();
        auto changes = tilesAfterEdits(
            generators_, rule(), changed, [&](world::ChunkPos pos) { return read(pos, tiles_); }, topLevel_);
        for (const TileChange& change : changes) {
            tiles_.erase(change.pos);
            if (change.tile) tiles_.insert({change.pos, change.tile});
        }
        return changes;
    }

    const Tiles& tiles() const { return tiles_; }
    // Builds the tiles from all edited chunks, as if there were no tiles.
    Tiles tilesFromScratch() const {
        std::vector<world::ChunkPos> all;
        for (const auto& [pos, chunk] : chunks_) all.push_back(pos);
        Tiles tiles;
        for (const TileChange& change : tilesAfterEdits(
                 generators_, rule(), all, [&](world::ChunkPos pos) { return read(pos, {}); }, topLevel_)) {
            EXPECT_TRUE(change.tile) << "there was none before";
            tiles.insert({change.pos, change.tile});
        }
        return tiles;
    }

    // The tile's block, or the generator's where the tile has no edits. x and y in columns of the level.
    world::BlockId block(int level, std::int32_t x, std::int32_t y, int z) {
        const world::ChunkPos pos{x >> 4, y >> 4, static_cast<std::uint8_t>(level)};
        const auto found = tiles_.find(pos);
        const world::Chunk& chunk = found == tiles_.end() ? generated(pos) : *found->second;
        return chunk.block(world::blockIndex(x & 15, y & 15, z));
    }
    const world::Chunk& generated(world::ChunkPos pos) {
        auto& chunk = generated_[pos];
        if (!chunk) chunk = std::make_unique<world::Chunk>(generators_.generate(pos));
        return *chunk;
    }

    static const world::DownsampleRule& rule() {
        static const world::DownsampleRule rule = world::downsampleRule(contentBlocks());
        return rule;
    }

  private:
    world::ChunkPtr read(world::ChunkPos pos, const Tiles& tiles) const {
        if (pos.level == 0) {
            const auto found = chunks_.find(pos);
            return found == chunks_.end() ? nullptr : found->second;
        }
        const auto found = tiles.find(pos);
        return found == tiles.end() ? nullptr : found->second;
    }
    world::Chunk& chunkAt(world::BlockPos pos) {
        changed_.insert(chunkOf(pos));
        auto& chunk = chunks_[chunkOf(pos)];
        if (!chunk) chunk = std::make_shared<world::Chunk>(generated(chunkOf(pos)));
        return *chunk;
    }

    const gen::LevelGenerators& generators_;
    int topLevel_;
    std::map<world::ChunkPos, std::shared_ptr<world::Chunk>> chunks_;
    std::map<world::ChunkPos, std::unique_ptr<world::Chunk>> generated_;
    std::set<world::ChunkPos> changed_;
    Tiles tiles_;
};

inline void expectSameTiles(const EditedWorld::Tiles& a, const EditedWorld::Tiles& b) {
    ASSERT_EQ(a.size(), b.size());
    for (auto one = a.begin(), other = b.begin(); one != a.end(); ++one, ++other) {
        ASSERT_EQ(one->first, other->first);
        ASSERT_TRUE(*one->second == *other->second) << int{one->first.level} << ": " << one->first.x;
    }
}

}  // namespace terrane::stream
