// Distance to rivers and lakes over rows of a tile, with the steps of gen_gpu/drainage.glsl. It is included
// once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_DRAINAGE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_DRAINAGE_KERNELS_INL_H
#undef TERRANE_GEN_DRAINAGE_KERNELS_INL_H
#else
#define TERRANE_GEN_DRAINAGE_KERNELS_INL_H
#endif

#include <algorithm>
#include <limits>

#include "terrane/gen/noise/tile_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

constexpr float kNoPower = std::numeric_limits<float>::max();

// The river and the lake that count so far, for one vector of columns.
struct NearestWater {
    VF power, distance2, halfWidth, level, flow, fall;
    VF lakePower, lakeDistance2, radius, lakeLevel;
};

// The nearest point of a segment.
struct PlaceOnSegment {
    VF along, distance2;  // 0…1 from its upper end; blocks²
};

HWY_INLINE PlaceOnSegment placeOn(const shared::RiverSegment& s, VF x, VF y) {
    const VF zero = hn::Zero(df), one = hn::Set(df, 1.0f);
    const VF dx = hn::Set(df, s.line.z), dy = hn::Set(df, s.line.w);
    const VF fromX = hn::Sub(x, hn::Set(df, s.line.x)), fromY = hn::Sub(y, hn::Set(df, s.line.y));
    VF t = hn::Mul(hn::Add(hn::Mul(fromX, dx), hn::Mul(fromY, dy)), hn::Set(df, s.course.x));
    t = hn::IfThenElse(hn::Lt(t, zero), zero, t);
    t = hn::IfThenElse(hn::Lt(one, t), one, t);
    const VF offX = hn::Sub(fromX, hn::Mul(t, dx)), offY = hn::Sub(fromY, hn::Mul(t, dy));
    return {t, hn::Add(hn::Mul(offX, offX), hn::Mul(offY, offY))};
}

HWY_INLINE void addSegment(NearestWater& w, const shared::RiverSegment& s, VF x, VF y, VF reach2) {
    const auto [t, distance2] = placeOn(s, x, y);
    const VF halfWidth = hn::Add(hn::Set(df, s.course.y), hn::Mul(t, hn::Set(df, s.course.z)));
    const VF power = hn::Sub(distance2, hn::Mul(halfWidth, halfWidth));
    const auto counts =
        hn::And(hn::And(hn::Lt(distance2, reach2), hn::Lt(power, w.power)), hn::Lt(hn::Zero(df), halfWidth));
    const VF level = hn::Add(hn::Set(df, s.course.w), hn::Mul(t, hn::Set(df, s.flow.x)));
    const VF flow = hn::Add(hn::Set(df, s.flow.y), hn::Mul(t, hn::Set(df, s.flow.z)));
    w.power = hn::IfThenElse(counts, power, w.power);
    w.distance2 = hn::IfThenElse(counts, distance2, w.distance2);
    w.halfWidth = hn::IfThenElse(counts, halfWidth, w.halfWidth);
    w.level = hn::IfThenElse(counts, level, w.level);
    w.flow = hn::IfThenElse(counts, flow, w.flow);
    w.fall = hn::IfThenElse(counts, hn::Set(df, s.flow.w), w.fall);
}

HWY_INLINE void addLake(NearestWater& w, const shared::vec4& lake, VF x, VF y, float reach) {
    const VF fromX = hn::Sub(x, hn::Set(df, lake.x)), fromY = hn::Sub(y, hn::Set(df, lake.y));
    const VF distance2 = hn::Add(hn::Mul(fromX, fromX), hn::Mul(fromY, fromY));
    const VF radius = hn::Set(df, lake.z), far = hn::Set(df, lake.z + reach);
    const VF power = hn::Sub(distance2, hn::Mul(radius, radius));
    const auto counts = hn::And(hn::Lt(distance2, hn::Mul(far, far)), hn::Lt(power, w.lakePower));
    w.lakePower = hn::IfThenElse(counts, power, w.lakePower);
    w.lakeDistance2 = hn::IfThenElse(counts, distance2, w.lakeDistance2);
    w.radius = hn::IfThenElse(counts, radius, w.radius);
    w.lakeLevel = hn::IfThenElse(counts, hn::Set(df, lake.w), w.lakeLevel);
}

void drainage(const Instruction& i, TileContext& c, const RowList& rows) {
    const DrainageTile& tile = c.drainage[i.imm];
    const VF reach2 = hn::Set(df, tile.reach * tile.reach), none = hn::Set(df, kNoRiver),
             noPower = hn::Set(df, kNoPower);
    const VF zero = hn::Zero(df);
    const VI step = hn::Set(di, tile.step);
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) HWY_ATTR {
        const VF x = hn::ConvertTo(df, hn::Mul(hn::Iota(di, static_cast<std::int32_t>(lane)), step));
        const VF y = hn::ConvertTo(df, hn::Set(di, row * tile.step));
        NearestWater w = {noPower, zero, zero, zero, zero, zero, noPower, zero, zero, zero};
        for (const shared::RiverSegment& s : tile.segments) addSegment(w, s, x, y, reach2);
        for (const shared::vec4& lake : tile.lakes) addLake(w, lake, x, y, tile.reach);
        const VF distance = hn::IfThenElse(hn::Lt(w.power, noPower), squareRoot(w.distance2), none);
        const VF shore = hn::Sub(squareRoot(w.lakeDistance2), w.radius);
        const VF lakeDistance = hn::IfThenElse(hn::Lt(w.lakePower, noPower), shore, none);
        const VF results[kDrainageResultCount] = {distance,     w.halfWidth, w.level, w.flow,
                                                  lakeDistance, w.lakeLevel, w.fall};
        for (std::uint32_t k = 0; k < kDrainageResultCount; ++k) {
            const Operand o{static_cast<std::uint16_t>(i.dst.row + k * kTileSize), 1};
            storeBits(results[k], rowOf(c.arena, o, row) + lane);
        }
    });
}

// Sums over the pieces of streams around, for one vector of columns.
struct StreamSums {
    VF weight, distance, level, flow;
};

HWY_INLINE void addStream(StreamSums& sums, const shared::RiverSegment& s, VF x, VF y, VF reach2,
                          VF reachWeight) {
    const VF one = hn::Set(df, 1.0f);
    const PlaceOnSegment at = placeOn(s, x, y);
    // One root for the distance, to a point one block above the stream, and for its weight.
    const VF distance2 = hn::Add(at.distance2, one), inverse = inverseRoot(distance2);
    const VF part = hn::Sub(hn::Mul(inverse, inverse), reachWeight);
    const VF weight = hn::IfThenElseZero(hn::Lt(at.distance2, reach2), hn::Mul(part, part));
    const VF level = hn::Add(hn::Set(df, s.course.w), hn::Mul(at.along, hn::Set(df, s.flow.x)));
    const VF flow = hn::Add(hn::Set(df, s.flow.y), hn::Mul(at.along, hn::Set(df, s.flow.z)));
    sums.weight = hn::Add(sums.weight, weight);
    sums.distance = hn::Add(sums.distance, hn::Mul(weight, hn::Mul(distance2, inverse)));
    sums.level = hn::Add(sums.level, hn::Mul(weight, level));
    sums.flow = hn::Add(sums.flow, hn::Mul(weight, flow));
}

// Results of the valleys at some places, each of kTileLanes floats.
struct ValleyPlaces {
    alignas(64) float x[kTileLanes], y[kTileLanes];  // blocks from the tile's first column
    alignas(64) float results[kValleysResultCount][kTileLanes];
};

// Computes the first `count` results and up to 2 · kRowLanes − 1 more. Two vectors at a time: their roots are
// computed side by side.
void findValleys(const DrainageTile& tile, ValleyPlaces& places, std::size_t count) {
    const VF reach2 = hn::Set(df, tile.valleyReach * tile.valleyReach);
    const VF zero = hn::Zero(df), one = hn::Set(df, 1.0f);
    const VF reachWeight = divide(one, hn::Add(reach2, one));
    const auto store = [&](std::size_t at, const StreamSums& sums) HWY_ATTR {
        const auto isValley = hn::Lt(hn::Set(df, shared::kLeastStreamWeight), sums.weight);
        const VF weight = hn::IfThenElse(isValley, sums.weight, one);
        const VF far = hn::Set(df, kNoRiver);
        hn::Store(hn::IfThenElse(isValley, divide(sums.distance, weight), far), df, &places.results[0][at]);
        hn::Store(hn::IfThenElseZero(isValley, divide(sums.level, weight)), df, &places.results[1][at]);
        hn::Store(hn::IfThenElseZero(isValley, divide(sums.flow, weight)), df, &places.results[2][at]);
    };
    const std::size_t lanes = hn::Lanes(df);
    for (std::size_t at = 0; at < count; at += 2 * lanes) {
        const VF x0 = hn::Load(df, places.x + at), x1 = hn::Load(df, places.x + at + lanes);
        const VF y0 = hn::Load(df, places.y + at), y1 = hn::Load(df, places.y + at + lanes);
        StreamSums s0 = {zero, zero, zero, zero}, s1 = s0;
        for (const shared::RiverSegment& s : tile.segments) {
            addStream(s0, s, x0, y0, reach2, reachWeight);
            addStream(s1, s, x1, y1, reach2, reachWeight);
        }
        store(at, s0);
        store(at + lanes, s1);
    }
}

// Columns narrower than kValleyBlocks are blended from places that far apart.
void valleys(const Instruction& i, TileContext& c, const RowList& rows) {
    const DrainageTile& tile = c.drainage[i.imm];
    const int stride = std::max(shared::kValleyBlocks / tile.step, 1);  // columns from place to place
    const int side = stride == 1 ? kTileSize : kTileSize / stride + 1, count = side * side;
    const auto partOf = [&](int column) {  // of the way to the next place
        return static_cast<float>(column % stride * tile.step) * (1.0f / shared::kValleyBlocks);
    };
    ValleyPlaces places;
    for (int k = 0; k < std::min<int>(count + 2 * kRowLanes, kTileLanes); ++k) {
        places.x[k] = static_cast<float>(k % side * stride * tile.step);
        places.y[k] = static_cast<float>(k / side * stride * tile.step);
    }
    findValleys(tile, places, static_cast<std::size_t>(count));
    for (std::uint32_t n = 0; n < kValleysResultCount; ++n) {
        const Operand o{static_cast<std::uint16_t>(i.dst.row + n * kTileSize), 1};
        const float* found = places.results[n];
        // Along x, by row of places.
        alignas(64) float blended[kTileSize + 1][kRowLanes];
        for (int y = 0; y < side; ++y) {
            for (int lane = 0; lane < kRowLanes; ++lane) {
                const float* at = found + y * side + lane / stride;
                blended[y][lane] = lane % stride == 0 ? at[0] : at[0] + (at[1] - at[0]) * partOf(lane);
            }
        }
        for (int k = 0; k < rows.count; ++k) {
            const int row = rows.rows[k], y = row / stride;
            const VF part = hn::Set(df, partOf(row));
            for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(df)) {
                VF value = hn::Load(df, blended[y] + lane);
                if (row % stride != 0) {
                    const VF next = hn::Load(df, blended[y + 1] + lane);
                    value = hn::Add(value, hn::Mul(hn::Sub(next, value), part));
                }
                storeBits(value, rowOf(c.arena, o, row) + lane);
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif
