// Fields and blocks of earlier passes over rows of a tile. It is included once for each instruction set by
// kernels.cpp.
#if defined(TERRANE_GEN_READ_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_READ_KERNELS_INL_H
#undef TERRANE_GEN_READ_KERNELS_INL_H
#else
#define TERRANE_GEN_READ_KERNELS_INL_H
#endif

#include <algorithm>
#include <cstring>

#include "terrane/gen/noise/tile_rows-inl.h"
#include "terrane/world/coords.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

void field(const Instruction& i, TileContext& c, const RowList& rows) {
    const Bits* values = c.fields[i.imm];
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        std::memcpy(rowOf(c.arena, i.dst, row), values + row * kRowLanes, kRowLanes * sizeof(Bits));
    }
}

int clampedOffset(Bits offset) {
    return std::clamp(asInt(offset), -kMaxReadOffset, kMaxReadOffset);
}

void fieldAt(const Instruction& i, TileContext& c, const RowList& rows) {
    const Bits* window = c.windows[i.imm].data();
    if (i.args[0].rowStep == 0 && i.args[1].rowStep == 0) {
        const int ox = clampedOffset(*rowOf(c.arena, i.args[0], 0)),
                  oy = clampedOffset(*rowOf(c.arena, i.args[1], 0));
        const Bits* first = window + (oy + kMaxReadOffset) * kWindowSize + ox + kMaxReadOffset;
        for (int k = 0; k < rows.count; ++k) {
            const int row = rows.rows[k];
            std::memcpy(rowOf(c.arena, i.dst, row), first + row * kWindowSize, kRowLanes * sizeof(Bits));
        }
        return;
    }
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        const Bits* dx = rowOf(c.arena, i.args[0], row);
        const Bits* dy = rowOf(c.arena, i.args[1], row);
        Bits* out = rowOf(c.arena, i.dst, row);
        for (int lane = 0; lane < kRowLanes; ++lane) {
            const int ox = clampedOffset(dx[lane]), oy = clampedOffset(dy[lane]);
            out[lane] = window[(row + oy + kMaxReadOffset) * kWindowSize + lane + ox + kMaxReadOffset];
        }
    }
}

void layerOf(const std::uint16_t* layer, const Instruction& i, TileContext& c, const RowList& rows) {
    const hn::Rebind<std::uint16_t, DI> d16;
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(di)) {
            const auto ids = hn::LoadU(d16, layer + static_cast<std::size_t>(row) * kRowLanes + lane);
            storeBits(hn::PromoteTo(di, ids), rowOf(c.arena, i.dst, row) + lane);
        }
    }
}

void blockLayer(const Instruction& i, TileContext& c, const RowList& rows, std::int32_t z) {
    layerOf(c.blocks->layer(z), i, c, rows);
}

void stamp(const Instruction& i, TileContext& c, const RowList& rows) {
    layerOf(c.stamps[i.imm].blocks().layer(c.z), i, c, rows);
}

void blockHere(const Instruction& i, TileContext& c, const RowList& rows) {
    blockLayer(i, c, rows, c.z);
}

void blockInColumn(const Instruction& i, TileContext& c, const RowList& rows) {
    const world::Heights heights = c.blocks->heights();
    // A height that is the same in every column, like that of the block below.
    if (i.args[0].rowStep == 0)
        return blockLayer(i, c, rows, heights.clamp(asInt(*rowOf(c.arena, i.args[0], 0))));
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        const Bits* z = rowOf(c.arena, i.args[0], row);
        Bits* out = rowOf(c.arena, i.dst, row);
        for (int lane = 0; lane < kRowLanes; ++lane) {
            out[lane] = c.blocks->layer(heights.clamp(asInt(z[lane])))[row * kRowLanes + lane];
        }
    }
}

void blockAt(const Instruction& i, TileContext& c, const RowList& rows) {
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        const Bits* dx = rowOf(c.arena, i.args[0], row);
        const Bits* dy = rowOf(c.arena, i.args[1], row);
        const Bits* z = rowOf(c.arena, i.args[2], row);
        Bits* out = rowOf(c.arena, i.dst, row);
        for (int lane = 0; lane < kRowLanes; ++lane) {
            // From the corner of the nine chunks.
            const int x = lane + kTileSize + clampedOffset(dx[lane]);
            const int y = row + kTileSize + clampedOffset(dy[lane]);
            const BlockLayers& chunk =
                *c.blocksAround[static_cast<std::size_t>(y / kTileSize * 3 + x / kTileSize)];
            const int layer = chunk.heights().clamp(asInt(z[lane]));
            out[lane] = chunk.layer(layer)[y % kTileSize * kTileSize + x % kTileSize];
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif
