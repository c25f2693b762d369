#include "terrane/stream/edited_tiles.h"

#include <algorithm>
#include <bitset>
#include <cassert>
#include <map>
#include <memory>
#include <set>
#include <unordered_map>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/stream/tile_table.h"
#include "terrane/world/downsample.h"

namespace terrane::stream {

using world::BlockId;
using world::ChunkPos;
using world::ChunkPtr;

namespace {

constexpr int kColumns = world::kChunkSize * world::kChunkSize;
constexpr int kHalf = world::kChunkSize / 2;

// Blocks of a whole chunk.
struct ChunkBlocks {
    world::Heights heights;
    std::vector<BlockId> values;  // by z from the bottom, y, x

    std::size_t indexOf(int x, int y, int z) const {
        return static_cast<std::size_t>(world::blockIndex(x, y, z - heights.bottom));
    }
    bool isEmpty() const { return values.empty(); }
};

ChunkBlocks unpackChunk(const world::Chunk& chunk) {
    ChunkBlocks blocks{chunk.heights(), {}};
    blocks.values.resize(static_cast<std::size_t>(blocks.heights.layers()) * kColumns);
    for (int s = blocks.heights.firstSection(); s < blocks.heights.endSection(); ++s) {
        const std::size_t first = blocks.indexOf(0, 0, s * world::kSectionSize);
        chunk.section(s).unpack(std::span(blocks.values).subspan(first).first<world::kBlocksPerSection>());
    }
    return blocks;
}

// The lowest ground of all columns: z of the first opaque block from above; the world's bottom if a column
// has none.
int lowestGround(const world::DownsampleRule& rule, const ChunkBlocks& blocks) {
    std::bitset<kColumns> found;
    for (int z = blocks.heights.top - 1; z > blocks.heights.bottom; --z) {
        const BlockId* layer = &blocks.values[blocks.indexOf(0, 0, z)];
        for (std::size_t i = 0; i < kColumns; ++i) {
            if (!found[i] && rule.kind(layer[i]).isOpaque) found.set(i);
        }
        if (found.all()) return z;
    }
    return blocks.heights.bottom;
}

// One child of a tile, with and without edits.
struct ChildBlocks {
    ChunkBlocks edited, generated;
    int seenFrom = 0;                    // lower blocks are not seen
    std::bitset<kColumns> hasChanged{};  // columns that differ visibly
};

ChildBlocks compareBlocks(const world::DownsampleRule& rule, const world::Chunk& edited,
                          const world::Chunk& generated) {
    ChildBlocks child{.edited = unpackChunk(edited), .generated = unpackChunk(generated)};
    const int ground = std::min(lowestGround(rule, child.edited), lowestGround(rule, child.generated));
    child.seenFrom = std::max(edited.heights().bottom, ground - kVisibleDepth);
    for (std::size_t i = child.edited.indexOf(0, 0, child.seenFrom); i < child.edited.values.size(); ++i) {
        if (child.edited.values[i] != child.generated.values[i]) child.hasChanged.set(i % kColumns);
    }
    return child;
}

// The column of a tile made of the four from x, y on.
world::BlockColumn parentColumn(const world::DownsampleRule& rule, const ChunkBlocks& blocks, int x, int y,
                                world::ColumnPos at) {
    std::array<world::BlockColumn, 4> four;
    for (int k = 0; k < 4; ++k) {
        auto& column = four[static_cast<std::size_t>(k)];
        column.resize(static_cast<std::size_t>(blocks.heights.layers()));
        const std::size_t first = blocks.indexOf(x + (k & 1), y + (k >> 1), blocks.heights.bottom);
        for (std::size_t z = 0; z < column.size(); ++z) column[z] = blocks.values[first + z * kColumns];
    }
    world::BlockColumn out;
    world::downsampleColumn(rule, four, at, out);
    return out;
}

// Writes the columns of a child that look different into the blocks of its tile.
void writeColumns(const world::DownsampleRule& rule, const ChildBlocks& child, ChunkPos tile, int quarter,
                  ChunkBlocks& blocks) {
    for (int n = 0; n < kHalf * kHalf; ++n) {
        const int x = n % kHalf * 2, y = n / kHalf * 2;
        const auto first = static_cast<std::size_t>(world::blockIndex(x, y, 0));
        constexpr std::size_t kBeside = world::kChunkSize;
        if (!child.hasChanged[first] && !child.hasChanged[first + 1] && !child.hasChanged[first + kBeside] &&
            !child.hasChanged[first + kBeside + 1]) {
            continue;
        }
        const int tileX = x / 2 + (quarter & 1) * kHalf, tileY = y / 2 + (quarter >> 1) * kHalf;
        const world::ColumnPos at{tile.x * world::kChunkSize + tileX, tile.y * world::kChunkSize + tileY,
                                  tile.level};
        const auto edited = parentColumn(rule, child.edited, x, y, at);
        const auto generated = parentColumn(rule, child.generated, x, y, at);
        const int seen = child.seenFrom - blocks.heights.bottom;
        if (std::equal(edited.begin() + seen, edited.end(), generated.begin() + seen)) continue;
        const std::size_t to = blocks.indexOf(tileX, tileY, blocks.heights.bottom);
        for (std::size_t z = 0; z < edited.size(); ++z) blocks.values[to + z * kColumns] = edited[z];
    }
}

// The tile with these blocks, without block state; null if its blocks are the same.
ChunkPtr withBlocks(const world::Chunk& tile, const ChunkBlocks& blocks) {
    std::shared_ptr<world::Chunk> changed;
    for (int s = blocks.heights.firstSection(); s < blocks.heights.endSection(); ++s) {
        const std::size_t first = blocks.indexOf(0, 0, s * world::kSectionSize);
        auto section = world::Section::fromValues(
            std::span(blocks.values).subspan(first).first<world::kBlocksPerSection>());
        if (section == tile.section(s)) continue;
        if (!changed) changed = std::make_shared<world::Chunk>(tile);
        changed->setSection(s, std::move(section));
    }
    return changed;
}

ChunkPos childOf(ChunkPos tile, int quarter) {
    return world::offsetBy(firstChildOf(tile), quarter & 1, quarter >> 1);
}

// A cache of generated chunks: a tile of one level is compared as a child on the next.
class GeneratedChunks {
  public:
    explicit GeneratedChunks(const gen::LevelGenerators& generators) : generators_(generators) {}

    const world::Chunk& at(ChunkPos pos) {
        auto& chunk = chunks_[pos];
        if (!chunk) chunk = std::make_unique<const world::Chunk>(generators_.generate(pos));
        return *chunk;
    }
    void forgetBelow(int level) {
        std::erase_if(chunks_, [&](const auto& entry) { return entry.first.level < level; });
    }

  private:
    const gen::LevelGenerators& generators_;
    std::map<ChunkPos, std::unique_ptr<const world::Chunk>> chunks_;
};

ChunkPtr editedTileOf(GeneratedChunks& generated, const world::DownsampleRule& rule, ChunkPos tile,
                      const std::array<ChunkPtr, 4>& children) {
    assert(tile.level > 0 && "level 0 is what players edit");
    ChunkBlocks blocks;  // empty until a column may differ
    for (int quarter = 0; quarter < 4; ++quarter) {
        const ChunkPtr& child = children[static_cast<std::size_t>(quarter)];
        if (!child) continue;
        const auto compared = compareBlocks(rule, *child, generated.at(childOf(tile, quarter)));
        if (compared.hasChanged.none()) continue;
        if (blocks.isEmpty()) blocks = unpackChunk(generated.at(tile));
        writeColumns(rule, compared, tile, quarter, blocks);
    }
    return blocks.isEmpty() ? nullptr : withBlocks(generated.at(tile), blocks);
}

bool isSameTile(const ChunkPtr& a, const ChunkPtr& b) {
    return a && b ? *a == *b : a == b;
}

}  // namespace

std::vector<TileChange> tilesAfterEdits(const gen::LevelGenerators& generators,
                                        const world::DownsampleRule& rule,
                                        std::span<const ChunkPos> editedChunks, const ReadTile& read,
                                        int topLevel) {
    base::require(topLevel <= world::kMaxLevel, "tilesAfterEdits: there is no such level");
    GeneratedChunks generated(generators);
    std::vector<TileChange> changes;
    std::set<ChunkPos> changed(editedChunks.begin(), editedChunks.end());
    std::map<ChunkPos, ChunkPtr> now;  // tiles of the level below that changed
    for (int level = 1; level <= topLevel && !changed.empty(); ++level) {
        std::set<ChunkPos> tiles;
        for (const ChunkPos pos : changed) tiles.insert(parentOf(pos));
        changed.clear();
        std::map<ChunkPos, ChunkPtr> next;
        for (const ChunkPos tile : tiles) {
            std::array<ChunkPtr, 4> children;
            for (int quarter = 0; quarter < 4; ++quarter) {
                const auto found = now.find(childOf(tile, quarter));
                children[static_cast<std::size_t>(quarter)] =
                    found != now.end() ? found->second : read(childOf(tile, quarter));
            }
            const bool isEdited =
                std::ranges::any_of(children, [](const ChunkPtr& c) { return c != nullptr; });
            if (isEdited && !generators.at(level)) return changes;
            ChunkPtr made = editedTileOf(generated, rule, tile, children);
            if (isSameTile(made, read(tile))) continue;
            changed.insert(tile);
            next[tile] = made;
            changes.push_back({tile, std::move(made)});
        }
        generated.forgetBelow(level);
        now = std::move(next);
    }
    return changes;
}

namespace {

// The version of the rules that derive tiles from chunks: rows of another version are built again.
constexpr std::string_view kRules = "1";

// The coarsest level of the widest view.
int topLevel() {
    return coarsestLevel({.horizon = kMaxHorizon, .detail = kMinDetail});
}

std::vector<store::ChunkRow> rowsAfterEdits(const gen::LevelGenerators& generators,
                                            const world::DownsampleRule& rule,
                                            std::span<const store::ChunkRow> edited,
                                            const store::ReadEdited& saved) {
    TERRANE_ZONE("tiles of edited chunks");
    std::vector<ChunkPos> positions;
    std::unordered_map<ChunkPos, ChunkPtr, world::ChunkPosHash> chunks;
    for (const store::ChunkRow& row : edited) {
        positions.push_back(row.pos);
        chunks.emplace(row.pos, row.chunk);
    }
    const auto read = [&](ChunkPos pos) {
        const auto found = chunks.find(pos);
        return found != chunks.end() ? found->second : saved(pos);
    };
    std::vector<store::ChunkRow> rows;
    for (TileChange& change : tilesAfterEdits(generators, rule, positions, read, topLevel()))
        rows.push_back({change.pos, std::move(change.tile)});
    return rows;
}

}  // namespace

void maintainTileRows(store::ChunkStore& store, const gen::LevelGenerators& generators,
                      const world::BlockRegistry& blocks, TileListener listener) {
    const auto tell = [listener = std::move(listener)](std::span<const store::ChunkRow> rows) {
        if (!listener) return;
        std::vector<ChunkPos> tiles;
        for (const store::ChunkRow& row : rows) tiles.push_back(row.pos);
        listener(tiles);
    };
    store.setDerivedRows(
        {[&generators, rule = world::downsampleRule(blocks)](auto edited, const auto& saved) {
             return rowsAfterEdits(generators, rule, edited, saved);
         },
         tell});
}

base::Result<void> buildTileRows(store::ChunkStore& store) {
    (void)TERRANE_TRY(store::ensureDerivedRows(store, kRules));
    return {};
}

}  // namespace terrane::stream
