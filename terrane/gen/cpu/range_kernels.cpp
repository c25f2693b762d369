#include "terrane/gen/cpu/range_kernels.h"

#include "terrane/gen/compile/program.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/gen/cpu/range_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<std::int32_t, kRowLanes> di;
constexpr hn::CappedTag<float, kRowLanes> df;

void rangeOfInts(const Bits* values, std::int32_t& lowest, std::int32_t& highest) {
    const auto load = [&](std::size_t k) HWY_ATTR {
        return hn::BitCast(di, hn::Load(hn::RebindToUnsigned<decltype(di)>(), values + k));
    };
    auto low = load(0), high = low;
    for (std::size_t k = hn::Lanes(di); k < kTileLanes; k += hn::Lanes(di)) {
        const auto v = load(k);
        low = hn::Min(low, v);
        high = hn::Max(high, v);
    }
    lowest = hn::GetLane(hn::MinOfLanes(di, low));
    highest = hn::GetLane(hn::MaxOfLanes(di, high));
}

// Returns false if some value is NaN.
bool rangeOfFloats(const Bits* values, float& lowest, float& highest) {
    const auto load = [&](std::size_t k) HWY_ATTR {
        return hn::BitCast(df, hn::Load(hn::RebindToUnsigned<decltype(df)>(), values + k));
    };
    auto low = load(0), high = low;
    auto isNumber = hn::Eq(low, low);
    for (std::size_t k = hn::Lanes(df); k < kTileLanes; k += hn::Lanes(df)) {
        const auto v = load(k);
        isNumber = hn::And(isNumber, hn::Eq(v, v));
        low = hn::Min(low, v);
        high = hn::Max(high, v);
    }
    if (!hn::AllTrue(df, isNumber)) return false;
    lowest = hn::GetLane(hn::MinOfLanes(df, low));
    highest = hn::GetLane(hn::MaxOfLanes(df, high));
    return true;
}

void packBlocks(const Bits* values, std::uint16_t* layer, std::uint16_t& lowest, std::uint16_t& highest) {
    constexpr hn::CappedTag<std::uint32_t, kRowLanes> du;
    constexpr hn::Rebind<std::uint16_t, decltype(du)> half;
    auto low = hn::Set(half, UINT16_MAX), high = hn::Zero(half);
    for (std::size_t k = 0; k < kTileLanes; k += hn::Lanes(du)) {
        const auto v = hn::TruncateTo(half, hn::Load(du, values + k));
        hn::StoreU(v, half, layer + k);
        low = hn::Min(low, v);
        high = hn::Max(high, v);
    }
    lowest = hn::GetLane(hn::MinOfLanes(half, low));
    highest = hn::GetLane(hn::MaxOfLanes(half, high));
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::gen {

HWY_EXPORT(rangeOfInts);
HWY_EXPORT(rangeOfFloats);
HWY_EXPORT(packBlocks);

ValueRange rangeOfTile(Type type, const Bits* values) {
    std::int32_t low = 0, high = 0;
    float lowF = 0, highF = 0;
    if (type == Type::Float) {
        return HWY_DYNAMIC_DISPATCH(rangeOfFloats)(values, lowF, highF) ? floatRange(lowF, highF) : kAnyFloat;
    }
    HWY_DYNAMIC_DISPATCH(rangeOfInts)(values, low, high);
    return intRange(low, high);
}

BlockRange packLayer(const Bits* values, std::uint16_t* blocks) {
    BlockRange r{};
    HWY_DYNAMIC_DISPATCH(packBlocks)(values, blocks, r.low, r.high);
    return r;
}

}  // namespace terrane::gen
#endif
