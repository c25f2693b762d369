#include "terrane/stream/tile_borders.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "terrane/stream/meshing.h"

namespace terrane::stream {

using world::ChunkPos;

SideSet openSides(const TileView& view, ChunkPos pos) {
    constexpr std::array<std::pair<int, int>, 4> kSides = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    if (view.horizon <= view.viewDistance || !isWithinView(view, parentOf(pos))) return 0;
    SideSet sides = 0;
    for (std::size_t side = 0; side < kSides.size(); ++side) {
        const ChunkPos beside = world::offsetBy(pos, kSides[side].first, kSides[side].second);
        if (world::isInWorld(beside) && !isWithinView(view, parentOf(beside)))
            sides |= static_cast<SideSet>(1u << side);
    }
    return sides;
}

world::ChunkPtr chunkBeyond(const world::BlockRegistry& blocks) {
    const auto types = blocks.types();
    const auto found = std::ranges::find(types, world::Shape::Liquid, &world::BlockType::shape);
    auto chunk = std::make_shared<world::Chunk>();
    if (found == types.end()) return chunk;
    for (int number = 0; number < world::kSectionsPerChunk; ++number)
        chunk->setSection(number, world::Section(found->id));
    return chunk;
}

void remeshBorders(ChunkTable& table, const TileView& before, const TileView& now) {
    if (before == now) return;
    for (auto& [pos, record] : table.records) {
        if (openSides(before, pos) == openSides(now, pos)) continue;
        record.isOutdated = true;  // running jobs have the old sides
        requestWholeMesh(table, pos);
    }
}

}  // namespace terrane::stream
