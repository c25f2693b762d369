#include "terrane/light/kernels.h"

#include <bit>

// The vectors of 16 bytes need SSSE3 at least, which every x86 with OpenGL 4.5 beside it has: Highway's
// fallback without vectors is left out.
#if defined(__x86_64__)
#define HWY_BASELINE_TARGETS HWY_SSSE3
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/light/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace terrane::light {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// 64 levels, a byte each, so that maximum and saturated difference of bytes are those of levels. Vector a
// holds x = 0…7, b holds 8…15: a block of 16 bytes with red and blue in the low four bits (even), and one
// with green and daylight in the high four (odd). Both blocks fit one vector of 32 bytes, or are two of 16.
const hn::CappedTag<std::uint8_t, 32> kBytes;
const hn::FixedTag<std::uint8_t, 16> kBlock;
using Bytes = hn::Vec<decltype(kBytes)>;
using Block = hn::Vec<decltype(kBlock)>;
constexpr int kParts = 32 / HWY_MIN(32, hn::MaxLanes(kBytes));
constexpr int kEven = 0, kOdd = kParts - 1;

struct Levels {
    Bytes a[kParts], b[kParts];
};

HWY_INLINE const std::uint8_t* bytesOf(const LightValue* values) {
    return reinterpret_cast<const std::uint8_t*>(values);
}

// The even bits of part kEven and the odd ones of part kOdd, in both where these are one.
HWY_INLINE Bytes maskOf(int part) {
    alignas(32) static constexpr std::uint8_t kMask[32] = {
        0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F, 0x0F,
        0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0, 0xF0};
    return hn::Load(kBytes, kMask + 16 * part);
}

// Eight values in each block of the vector.
HWY_INLINE Bytes loadHalf(const LightValue* values) {
    return hn::LoadDup128(kBytes, bytesOf(values));
}

HWY_INLINE Levels loadRow(const LightValue* row) {
    const Bytes a = loadHalf(row), b = loadHalf(row + 8);
    Levels levels;
    for (int p = 0; p < kParts; ++p) {
        levels.a[p] = hn::And(a, maskOf(p));
        levels.b[p] = hn::And(b, maskOf(p));
    }
    return levels;
}

HWY_INLINE void storeHalf(const Bytes (&parts)[kParts], LightValue* values) {
    auto* out = reinterpret_cast<std::uint8_t*>(values);
#if HWY_MAX_BYTES >= 32
    hn::StoreU(hn::Or(hn::LowerHalf(kBlock, parts[0]), hn::UpperHalf(kBlock, parts[0])), kBlock, out);
#else
    hn::StoreU(hn::Or(parts[kEven], parts[kOdd]), kBlock, out);
#endif
}

HWY_INLINE void storeRow(const Levels& levels, LightValue* row) {
    storeHalf(levels.a, row);
    storeHalf(levels.b, row + 8);
}

template <class Function>
HWY_INLINE Levels each(Function f, const Levels& p, const Levels& q) {
    Levels result;
    for (int k = 0; k < kParts; ++k) {
        result.a[k] = f(p.a[k], q.a[k]);
        result.b[k] = f(p.b[k], q.b[k]);
    }
    return result;
}

HWY_INLINE Levels maxOf(const Levels& p, const Levels& q) {
    return each([](Bytes a, Bytes b) HWY_ATTR { return hn::Max(a, b); }, p, q);
}

HWY_INLINE Levels minus(const Levels& p, const Levels& q) {
    return each([](Bytes a, Bytes b) HWY_ATTR { return hn::SaturatedSub(a, b); }, p, q);
}

// Levels of p where they exceed those of q, else 0.
HWY_INLINE Levels whereAbove(const Levels& p, const Levels& q) {
    return each([](Bytes a, Bytes b) HWY_ATTR { return hn::IfThenElseZero(hn::Gt(a, b), a); }, p, q);
}

HWY_INLINE bool isSame(const Levels& p, const Levels& q) {
    const Levels differences = each([](Bytes a, Bytes b) HWY_ATTR { return hn::Xor(a, b); }, p, q);
    Bytes any = hn::Or(differences.a[0], differences.b[0]);
    if (kParts == 2) any = hn::Or(any, hn::Or(differences.a[kOdd], differences.b[kOdd]));
    return hn::AllTrue(kBytes, hn::Eq(any, hn::Zero(kBytes)));
}

// 1 + opacity. An odd one of 15 saturates at 255, which darkens 240 as 256 would.
HWY_INLINE Levels lossOf(const LightValue* opacity) {
    Levels loss = loadRow(opacity);
    for (int p = 0; p < kParts; ++p) {
        const Bytes one = hn::And(maskOf(p), hn::Set(kBytes, 0x11));
        loss.a[p] = hn::SaturatedAdd(loss.a[p], one);
        loss.b[p] = hn::SaturatedAdd(loss.b[p], one);
    }
    return loss;
}

// The brighter of the voxels at x − 1 and x + 1. `west` ends with the voxel before the row, `east` begins
// with the one after it.
HWY_INLINE Levels brighterBeside(Bytes west, const Levels& row, Bytes east) {
    Levels result;
    for (int p = 0; p < kParts; ++p) {
        const Bytes a = row.a[p], b = row.b[p];
        const Bytes before = hn::And(west, maskOf(p)), after = hn::And(east, maskOf(p));
        result.a[p] = hn::Max(hn::CombineShiftRightBytes<14>(kBytes, a, before),
                              hn::CombineShiftRightBytes<2>(kBytes, b, a));
        result.b[p] = hn::Max(hn::CombineShiftRightBytes<14>(kBytes, b, a),
                              hn::CombineShiftRightBytes<2>(kBytes, after, b));
    }
    return result;
}

// A row and where its neighbours are.
struct RowPlace {
    const LightValue *self, *west, *east, *south, *north, *below, *above;
};

HWY_INLINE RowPlace placeOf(const FieldBrick* brick, int row) {
    const int y = row & 15, z = row >> 4, at = 16 * row;
    const auto light = [&](int step) { return brick[step].light.values; };
    return {light(0) + at,
            light(-LightField::kStepX) + at + 8,
            light(LightField::kStepX) + at,
            y > 0 ? light(0) + at - 16 : light(-LightField::kStepY) + at + 240,
            y < 15 ? light(0) + at + 16 : light(LightField::kStepY) + at - 240,
            z > 0 ? light(0) + at - 256 : light(-LightField::kStepZ) + at + 3840,
            z < 15 ? light(0) + at + 256 : light(LightField::kStepZ) + at - 3840};
}

// Voxels become as bright as their neighbours make them.
struct Raise {
    HWY_INLINE Levels operator()(const Levels& offered, const Levels& old, const FieldBrick& brick,
                                 int row) const {
        return maxOf(old, whereAbove(offered, loadRow(brick.reach + 16 * (row & 15))));
    }
};

// Levels that a suspect gave, and that have no source of their own, become suspects.
struct Suspect {
    HWY_INLINE Levels operator()(const Levels& offered, const Levels& old, const FieldBrick& brick,
                                 int row) const {
        const Levels before = loadRow(brick.before + 16 * row);
        const Levels lit = whereAbove(before, loadRow(brick.source + 16 * row));
        const auto given = [](Bytes level, Bytes offer) HWY_ATTR {
            return hn::IfThenElseZero(hn::Eq(hn::Max(level, offer), offer), level);
        };
        return maxOf(old, each(given, lit, offered));
    }
};

// What changed of a row: any voxel, its first, its last.
struct RowChange {
    bool any = false, first = false, last = false;
};

// Applies the rule to a row until nothing changes inside it, and writes it.
template <class Rule>
HWY_INLINE RowChange updateRow(LightField& field, FieldBrick& brick, int row, Rule rule) {
    const RowPlace at = placeOf(&brick, row);
    const Levels old = loadRow(at.self), loss = lossOf(brick.opacity + 16 * row);
    const Bytes west = loadHalf(at.west), east = loadHalf(at.east);
    const Levels aroundZ = maxOf(loadRow(at.below), loadRow(at.above));
    const Levels aroundYZ = maxOf(aroundZ, maxOf(loadRow(at.south), loadRow(at.north)));
    const Levels around = maxOf(aroundYZ, brighterBeside(west, old, east));

    Levels now = rule(minus(around, loss), old, brick, row);
    if (isSame(old, now)) return {};
    for (;;) {
        const Levels before = now;
        now = rule(minus(brighterBeside(west, now, east), loss), now, brick, row);
        if (isSame(before, now)) break;
    }
    LightValue* out = field.writable(brick) + 16 * row;
    const LightValue oldFirst = out[0], oldLast = out[15];
    storeRow(now, out);
    return {true, out[0] != oldFirst, out[15] != oldLast};
}

void markBeside(LightField& field, int index, int row, const RowChange& change) {
    using F = LightField;
    const int y = row & 15, z = row >> 4;
    y > 0 ? field.markRow(index, row - 1) : field.markRow(index - F::kStepY, row + 15);
    y < 15 ? field.markRow(index, row + 1) : field.markRow(index + F::kStepY, row - 15);
    z > 0 ? field.markRow(index, row - 16) : field.markRow(index - F::kStepZ, row + 240);
    z < 15 ? field.markRow(index, row + 16) : field.markRow(index + F::kStepZ, row - 240);
    if (change.first) field.markRow(index - F::kStepX, row);
    if (change.last) field.markRow(index + F::kStepX, row);
}

// Rows are taken upward and downward in turn, so that light that rises and light that falls both go far in
// one pass.
template <class Rule>
void settleBrick(LightField& field, int index, Rule rule) {
    FieldBrick& brick = field.brick(index);
    auto& dirty = brick.dirty;
    const auto update = [&](std::size_t word, int bit) {
        dirty[word] &= ~(std::uint64_t{1} << bit);
        const int row = static_cast<int>(64 * word) + bit;
        const RowChange change = updateRow(field, brick, row, rule);
        if (change.any) markBeside(field, index, row, change);
    };
    while ((dirty[0] | dirty[1] | dirty[2] | dirty[3]) != 0) {
        for (std::size_t word = 4; word-- > 0;) {
            // Rows marked above the last one wait for the way up.
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

template <class Rule>
void settle(LightField& field, Rule rule) {
    for (int index = field.takeDirty(); index >= 0; index = field.takeDirty())
        settleBrick(field, index, rule);
}

void raise(LightField& field) {
    settle(field, Raise());
}

void suspect(LightField& field) {
    settle(field, Suspect());
}

void shine(const LightValue* opacity, const LightValue* emission, DaylightColumns& columns,
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

void replace(const LightValue* suspects, const LightValue* source, const LightValue* before,
             LightValue* light) {
    const auto where = [](Bytes suspected, Bytes value) HWY_ATTR {
        return hn::IfThenZeroElse(hn::Eq(suspected, hn::Zero(kBytes)), value);
    };
    const auto whereNot = [](Bytes suspected, Bytes value) HWY_ATTR {
        return hn::IfThenElseZero(hn::Eq(suspected, hn::Zero(kBytes)), value);
    };
    for (int at = 0; at < world::kBlocksPerSection; at += 16) {
        const Levels s = loadRow(suspects + at);
        storeRow(maxOf(each(where, s, loadRow(source + at)), each(whereNot, s, loadRow(before + at))),
                 light + at);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::light
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::light {

HWY_EXPORT(shine);
HWY_EXPORT(raise);
HWY_EXPORT(suspect);
HWY_EXPORT(replace);

void shineDown(const LightValue* opacity, const LightValue* emission, DaylightColumns& columns,
               LightValue* light) {
    HWY_DYNAMIC_DISPATCH(shine)(opacity, emission, columns, light);
}

void raiseLight(LightField& field) {
    HWY_DYNAMIC_DISPATCH(raise)(field);
}

void spreadSuspects(LightField& field) {
    HWY_DYNAMIC_DISPATCH(suspect)(field);
}

void replaceSuspects(const LightValue* suspects, const LightValue* source, const LightValue* before,
                     LightValue* light) {
    HWY_DYNAMIC_DISPATCH(replace)(suspects, source, before, light);
}

}  // namespace terrane::light
#endif
