#include "terrane/light/kernels_internal.h"

#include <bit>

// Vectors of 16 bytes need SSSE3, which every x86 with a driver for OpenGL 4.5 has. So Highway's fallback
// without vectors is not compiled.
#if defined(__x86_64__)
#define HWY_BASELINE_TARGETS HWY_SSSE3
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/light/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "terrane/light/light_levels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::light {
namespace HWY_NAMESPACE {
// Light of the bricks beside one, which stays while the one changes.
using LightBeside = std::array<const LightValue*, kSideCount>;

// Pointers to the values of a row and of its neighbors.
struct RowPlace {
    const LightValue *self, *west, *east, *south, *north, *below, *above;
};

HWY_INLINE RowPlace placeOf(const LightValue* self, const LightBeside& beside, int row) {
    const int y = row & 15, z = row >> 4, at = 16 * row;
    return {self + at,
            beside[kWest] + at + 8,
            beside[kEast] + at,
            y > 0 ? self + at - 16 : beside[kSouth] + at + 240,
            y < 15 ? self + at + 16 : beside[kNorth] + at - 240,
            z > 0 ? self + at - 256 : beside[kBelow] + at + 3840,
            z < 15 ? self + at + 256 : beside[kAbove] + at - 3840};
}

// Raises voxels to the light that their neighbors give them.
struct Raise {
    HWY_INLINE LightLevels operator()(const LightLevels& offered, const LightLevels& old,
                                      const FieldBrick& brick, int row) const {
        return maxOf(old, whereAbove(offered, loadRow(brick.reach + 16 * (row & 15))));
    }
};

// Removes levels that came from a removed level and have no source of their own.
struct Decrease {
    HWY_INLINE LightLevels operator()(const LightLevels& offered, const LightLevels& old,
                                      const FieldBrick& brick, int row) const {
        const LightLevels before = loadRow(brick.before + 16 * row);
        const LightLevels lit = whereAbove(before, loadRow(brick.source + 16 * row));
        const auto given = [](Bytes level, Bytes offer) HWY_ATTR {
            return hn::IfThenElseZero(hn::Eq(hn::Max(level, offer), offer), level);
        };
        return maxOf(old, each(given, lit, offered));
    }
};

// Changes of a row: any voxel, its first, its last.
struct RowChange {
    bool any = false, first = false, last = false;
};

// Applies the rule to a row until nothing changes inside it, and writes the row.
template <class Rule>
HWY_INLINE RowChange updateRow(LightField& field, FieldBrick& brick, const LightBeside& beside, int row,
                               Rule rule) {
    const RowPlace at = placeOf(brick.light.values, beside, row);
    const LightLevels old = loadRow(at.self), loss = lossOf(brick.opacity + 16 * row);
    const Half west = loadHalf(at.west), east = loadHalf(at.east);
    const LightLevels aroundZ = maxOf(loadRow(at.below), loadRow(at.above));
    const LightLevels aroundYZ = maxOf(aroundZ, maxOf(loadRow(at.south), loadRow(at.north)));
    const LightLevels around = maxOf(aroundYZ, brighterBeside(west, old, east));

    LightLevels now = rule(minus(around, loss), old, brick, row);
    if (isSame(old, now)) return {};
    for (;;) {
        const LightLevels before = now;
        now = rule(minus(brighterBeside(west, now, east), loss), now, brick, row);
        if (isSame(before, now)) break;
    }
    LightValue* out = field.writable(brick) + 16 * row;
    const LightValue oldFirst = out[0], oldLast = out[15];
    storeRow(now, out);
    return {true, out[0] != oldFirst, out[15] != oldLast};
}

void markBeside(LightField& field, int index, const std::array<int, kSideCount>& beside, int row,
                const RowChange& change) {
    const int y = row & 15, z = row >> 4;
    y > 0 ? field.markRow(index, row - 1) : field.markRow(beside[kSouth], row + 15);
    y < 15 ? field.markRow(index, row + 1) : field.markRow(beside[kNorth], row - 15);
    z > 0 ? field.markRow(index, row - 16) : field.markRow(beside[kBelow], row + 240);
    z < 15 ? field.markRow(index, row + 16) : field.markRow(beside[kAbove], row - 240);
    if (change.first) field.markRow(beside[kWest], row);
    if (change.last) field.markRow(beside[kEast], row);
}

// Processes rows downward and upward in turn, so that light travels far in both directions in one pass.
template <class Rule>
void settleBrick(LightField& field, int index, Rule rule) {
    FieldBrick& brick = field.brick(index);
    auto& dirty = brick.dirty;
    LightBeside beside;
    for (std::size_t side = 0; side < kSideCount; ++side)
        beside[side] = field.brick(brick.beside[side]).light.values;
    const auto update = [&](std::size_t word, int bit) {
        dirty[word] &= ~(std::uint64_t{1} << bit);
        const int row = static_cast<int>(64 * word) + bit;
        const RowChange change = updateRow(field, brick, beside, row, rule);
        if (change.any) markBeside(field, index, brick.beside, row, change);
    };
    while ((dirty[0] | dirty[1] | dirty[2] | dirty[3]) != 0) {
        for (std::size_t word = 4; word-- > 0;) {
            // Rows marked above the last one are processed on the way up.
            std::uint64_t below = ~std::uint64_t{0};
            while ((dirty[word] & below) != 0) {
                const int bit = 63 - std::countl_zero(dirty[word] & below);
                below = (std::uint64_t{1} << bit) - 1;
                update(word, bit);
            }
        }
        for (std::size_t word = 0; word < 4; ++word) {
            std::uint64_t above = ~std::uint64_t{0};
            while ((dirty[word] & above) != 0) {
                const int bit = std::countr_zero(dirty[word] & above);
                above = ~std::uint64_t{1} << bit;
                update(word, bit);
            }
        }
    }
}

void raise(LightField& field, int index) {
    settleBrick(field, index, Raise());
}

void decrease(LightField& field, int index) {
    settleBrick(field, index, Decrease());
}

void sunlight(const LightValue* opacity, const LightValue* emission, DaylightColumns& columns,
              LightValue* light) {
    const hn::CappedTag<LightValue, 16> d;
    const auto daylight = hn::Set(d, kFullDaylight);
    for (int z = world::kSectionSize - 1; z >= 0; --z) {
        for (std::size_t column = 0; column < columns.size(); column += hn::Lanes(d)) {
            const std::size_t at = columns.size() * static_cast<std::size_t>(z) + column;
            const auto taken = hn::And(hn::LoadU(d, opacity + at), daylight);
            const auto level = hn::SaturatedSub(hn::LoadU(d, columns.data() + column), taken);
            hn::StoreU(level, d, columns.data() + column);
            hn::StoreU(hn::Or(level, hn::LoadU(d, emission + at)), d, light + at);
        }
    }
}

void replace(const LightValue* decreased, const LightValue* source, const LightValue* before,
             LightValue* light) {
    const auto where = [](Bytes level, Bytes value)
                           HWY_ATTR { return hn::IfThenZeroElse(hn::Eq(level, hn::Zero(kBytes)), value); };
    const auto whereNot = [](Bytes level, Bytes value)
                              HWY_ATTR { return hn::IfThenElseZero(hn::Eq(level, hn::Zero(kBytes)), value); };
    for (int at = 0; at < world::kBlocksPerSection; at += 16) {
        const LightLevels s = loadRow(decreased + at);
        if (isSame(s, minus(s, s))) {
            storeRow(loadRow(before + at), light + at);
            continue;
        }
        storeRow(maxOf(each(where, s, loadRow(source + at)), each(whereNot, s, loadRow(before + at))),
                 light + at);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::light
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::light {

HWY_EXPORT(sunlight);
HWY_EXPORT(raise);
HWY_EXPORT(decrease);
HWY_EXPORT(replace);

void propagateSunlight(const LightValue* opacity, const LightValue* emission, DaylightColumns& columns,
                       LightValue* light) {
    HWY_DYNAMIC_DISPATCH(sunlight)(opacity, emission, columns, light);
}

void raiseBrick(LightField& field, int index) {
    HWY_DYNAMIC_DISPATCH(raise)(field, index);
}

void raiseLight(LightField& field) {
    for (int index = field.popDirty(); index != 0; index = field.popDirty()) raiseBrick(field, index);
}

void decreaseBrick(LightField& field, int index) {
    HWY_DYNAMIC_DISPATCH(decrease)(field, index);
}

void replaceDecreased(const LightValue* decreased, const LightValue* source, const LightValue* before,
                      LightValue* light) {
    HWY_DYNAMIC_DISPATCH(replace)(decreased, source, before, light);
}

}  // namespace terrane::light
#endif
