#include "terrane/stream/tile_rows.h"

#include <memory>
#include <unordered_map>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/stream/edited_tiles.h"
#include "terrane/world/downsample.h"

namespace terrane::stream {

using world::ChunkPos;
using world::ChunkPtr;

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

void keepTileRows(store::ChunkStore& store, const gen::LevelGenerators& generators,
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
