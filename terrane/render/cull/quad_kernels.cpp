#include "terrane/render/cull/quad_kernels.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/render/cull/quad_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace terrane::render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace sh = terrane::shared;

constexpr hn::CappedTag<float, kQuadLanes> df;
constexpr hn::RebindToSigned<decltype(df)> di;
constexpr hn::RebindToUnsigned<decltype(df)> du;
using F = hn::Vec<decltype(df)>;
using I = hn::Vec<decltype(di)>;
using U = hn::Vec<decltype(du)>;
using Mask = hn::Mask<decltype(df)>;

HWY_INLINE F set(float value) {
    return hn::Set(df, value);
}
template <int kShift>
HWY_INLINE U bits(U word, std::uint32_t mask) {
    return hn::And(hn::ShiftRight<kShift>(word), hn::Set(du, mask));
}
HWY_INLINE F number(U value) {
    return hn::ConvertTo(df, hn::BitCast(di, value));
}

// Three components of points and directions: of the world, or x, y and w of clip space.
struct Three {
    F x, y, z;
};
HWY_INLINE Three add(const Three& a, const Three& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Three scale(const Three& a, F b) {
    return {hn::Mul(a.x, b), hn::Mul(a.y, b), hn::Mul(a.z, b)};
}

// A row of the matrix to clip space, for positions in cells of the chunk.
struct Row {
    float x, y, z, w;

    HWY_INLINE F direction(const Three& v) const {
        return hn::MulAdd(set(x), v.x, hn::MulAdd(set(y), v.y, hn::Mul(set(z), v.z)));
    }
    HWY_INLINE F point(const Three& v) const { return hn::Add(direction(v), set(w)); }
};

struct Rows {
    Row x, y, w;

    explicit Rows(const QuadTest& test) : x(rowOf(test, 0)), y(rowOf(test, 1)), w(rowOf(test, 3)) {}
    static Row rowOf(const QuadTest& test, int k) {
        const glm::mat4& m = test.view.viewProjection;
        const glm::vec3 at = test.slabCorner;
        return {m[0][k] * test.columnWidth, m[1][k] * test.columnWidth, m[2][k],
                m[0][k] * at.x + m[1][k] * at.y + m[2][k] * at.z + m[3][k]};
    }
    HWY_INLINE Three direction(const Three& v) const {
        return {x.direction(v), y.direction(v), w.direction(v)};
    }
    HWY_INLINE Three point(const Three& v) const { return {x.point(v), y.point(v), w.point(v)}; }
};

// Part `part` (base, axisU, axisV, bend) of the faces with these numbers.
HWY_INLINE Three shapePart(const float* faces, I numbers, bool isSame, std::int32_t same, int part) {
    if (isSame) {
        const float* at = faces + 16 * same + 4 * part;
        return {set(at[0]), set(at[1]), set(at[2])};
    }
    const I index = hn::Add(hn::ShiftLeft<4>(numbers), hn::Set(di, 4 * part));
    return {hn::GatherIndex(df, faces, index), hn::GatherIndex(df, faces + 1, index),
            hn::GatherIndex(df, faces + 2, index)};
}

HWY_INLINE F negative(F a) {
    return hn::Min(a, hn::Zero(df));
}

struct Bounds {
    F lowX, lowY, highX, highY, nearest;
    Mask isBefore, isBack;
};

HWY_INLINE Bounds boundsOf(const QuadTest& test, const Rows& rows, U word0, U word1) {
    const I shape =
        hn::BitCast(di, hn::Or(bits<16>(word0, 255), hn::And(hn::ShiftRight<8>(word1), hn::Set(du, 0x700))));
    const std::int32_t same = hn::GetLane(shape);
    const bool isSame = hn::AllTrue(di, hn::Eq(shape, hn::Set(di, same)));
    const float* faces = &test.shapeFaces.data()->base.x;
    const Three base = shapePart(faces, shape, isSame, same, 0), u = shapePart(faces, shape, isSame, same, 1),
                v = shapePart(faces, shape, isSame, same, 2);
    const F one = set(1);
    const F extentU = hn::Add(number(bits<24>(word0, 15)), one);
    const F extentV = hn::Add(number(hn::ShiftRight<28>(word0)), one);
    const auto corner = [&](U cell, F of, F alongU, F alongV) HWY_ATTR {
        return hn::NegMulAdd(negative(alongV), extentV,
                             hn::NegMulAdd(negative(alongU), extentU, hn::Add(number(cell), of)));
    };
    const Three clip0 = rows.point({corner(hn::And(word0, hn::Set(du, 15)), base.x, u.x, v.x),
                                    corner(bits<4>(word0, 15), base.y, u.y, v.y),
                                    corner(bits<8>(word0, 255), base.z, u.z, v.z)});
    const Three alongU = scale(rows.direction(u), extentU), alongV = scale(rows.direction(v), extentV);
    const Three clip1 = add(clip0, alongU), clip2 = add(clip0, alongV);
    Three clip3 = add(clip1, alongV);
    const I count = hn::Set(di, static_cast<std::int32_t>(sh::kShapeFaceCount));
    if (!hn::AllTrue(di, hn::Lt(shape, count)))
        clip3 = add(clip3, rows.direction(shapePart(faces, shape, isSame, same, 3)));

    const I material = hn::BitCast(di, hn::And(word1, hn::Set(du, 65535)));
    const U wavingBit = hn::GatherIndex(du, test.isWaving.data(), material);
    const F waving = hn::Mul(number(wavingBit), set(sh::kWaving));
    const F least = hn::Sub(hn::Min(hn::Min(clip0.z, clip1.z), hn::Min(clip2.z, clip3.z)), waving);
    Bounds bounds;
    const float nearPlane = test.view.nearPlane;
    bounds.isBefore = hn::Gt(least, set(2 * nearPlane));
    // Lanes that are not before the camera have no meaning, but are numbers.
    const auto inImage = [&](const Three& clip, F& x, F& y) HWY_ATTR {
        const F w = hn::IfThenElse(bounds.isBefore, clip.z, one);
        const F half = hn::Div(set(0.5f), w);
        x = hn::Mul(hn::MulAdd(hn::IfThenElseZero(bounds.isBefore, clip.x), half, set(0.5f)),
                    set(test.view.viewportSize.x));
        y = hn::Mul(hn::MulAdd(hn::IfThenElseZero(bounds.isBefore, clip.y), half, set(0.5f)),
                    set(test.view.viewportSize.y));
    };
    F x0, y0, x1, y1, x2, y2, x3, y3;
    inImage(clip0, x0, y0);
    inImage(clip1, x1, y1);
    inImage(clip2, x2, y2);
    inImage(clip3, x3, y3);
    const F ux = hn::Sub(x1, x0), uy = hn::Sub(y1, y0), vx = hn::Sub(x2, x0), vy = hn::Sub(y2, y0);
    const F lengths =
        hn::Max(hn::Sqrt(hn::Mul(hn::MulAdd(ux, ux, hn::Mul(uy, uy)), hn::MulAdd(vx, vx, hn::Mul(vy, vy)))),
                set(1e-12f));
    const F turn = hn::NegMulAdd(uy, vx, hn::Mul(ux, vy));
    const I cross = hn::Set(di, static_cast<std::int32_t>(sh::kShapeFaceCross));
    bounds.isBack = hn::And(hn::Lt(turn, set(-sh::kLeastBack)), hn::RebindMask(df, hn::Lt(shape, cross)));
    if (test.isTwoSided) {
        if (test.view.hidesBacks == 0) bounds.isBack = hn::FirstN(df, 0);
    } else {
        bounds.isBack = hn::And(bounds.isBack, hn::RebindMask(df, hn::Eq(wavingBit, hn::Zero(du))));
    }
    const F sine = hn::Div(hn::Abs(turn), lengths);
    const F miter = hn::Min(hn::Div(one, hn::Max(sine, set(1e-6f))), set(sh::kLongestMiter));
    const F distance = hn::Max(least, set(nearPlane));
    const F margin = hn::MulAdd(
        set(4 * test.view.edgeExpansion), miter,
        hn::Add(set(sh::kQuadRounding), hn::Div(hn::Mul(waving, set(test.view.blockPixels)), distance)));
    bounds.lowX = hn::Sub(hn::Min(hn::Min(x0, x1), hn::Min(x2, x3)), margin);
    bounds.lowY = hn::Sub(hn::Min(hn::Min(y0, y1), hn::Min(y2, y3)), margin);
    bounds.highX = hn::Add(hn::Max(hn::Max(x0, x1), hn::Max(x2, x3)), margin);
    bounds.highY = hn::Add(hn::Max(hn::Max(y0, y1), hn::Max(y2, y3)), margin);
    bounds.nearest = hn::Div(set(1.0001f * nearPlane), distance);
    return bounds;
}

HWY_INLINE Mask isInView(const QuadTest& test, const Bounds& b, float margin) {
    const F low = set(-margin);
    return hn::And(hn::And(hn::Ge(b.highX, low), hn::Ge(b.highY, low)),
                   hn::And(hn::Le(b.lowX, set(test.view.viewportSize.x + margin)),
                           hn::Le(b.lowY, set(test.view.viewportSize.y + margin))));
}

HWY_INLINE Mask hasSample(const QuadTest& test, const Bounds& b) {
    if (test.view.samples > 1) return hn::MaskFromVec(hn::BitCast(df, hn::Set(du, ~0u)));
    const F half = set(0.5f);
    const auto isCovered = [&](F low, F high) HWY_ATTR {
        return hn::Le(hn::Ceil(hn::Sub(low, half)), hn::Floor(hn::Sub(high, half)));
    };
    return hn::And(isCovered(b.lowX, b.highX), isCovered(b.lowY, b.highY));
}

HWY_INLINE F farthestIn(const DepthPyramid& pyramid, const QuadTest& test, const Bounds& b) {
    static_assert(sh::kHiZTexelPixels == 2);
    const auto texel = [&](F at, float end) HWY_ATTR {
        const F inside = hn::Min(hn::Max(at, hn::Zero(df)), set(end - 1));
        return hn::ShiftRight<1>(hn::ConvertTo(di, inside));
    };
    const float endX = test.view.viewportSize.x, endY = test.view.viewportSize.y;
    I x0 = texel(b.lowX, endX), y0 = texel(b.lowY, endY), x1 = texel(b.highX, endX),
      y1 = texel(b.highY, endY);
    // The highest bit of the larger side is the exponent of that number.
    const I side = hn::Max(hn::Max(hn::Sub(x1, x0), hn::Sub(y1, y0)), hn::Set(di, 1));
    const I exponent =
        hn::Sub(hn::ShiftRight<23>(hn::BitCast(di, hn::ConvertTo(df, side))), hn::Set(di, 127));
    const I level = hn::Min(exponent, hn::Set(di, test.view.hiZLevels - 1));
    x0 = hn::Shr(x0, level);
    y0 = hn::Shr(y0, level);
    x1 = hn::Shr(x1, level);
    y1 = hn::Shr(y1, level);
    const std::int32_t* levels = &pyramid.levels.data()->first;
    const I record = hn::Add(level, hn::Add(level, level));  // of three integers
    const I first = hn::GatherIndex(di, levels, record), width = hn::GatherIndex(di, levels + 1, record);
    F farthest = set(1);
    I y = y0;
    for (int row = 0; row < 3; ++row) {
        const I start = hn::Add(first, hn::Mul(y, width));
        I x = x0;
        for (int column = 0; column < 3; ++column) {
            farthest = hn::Min(farthest, hn::GatherIndex(df, pyramid.texels.data(), hn::Add(start, x)));
            x = hn::Min(hn::Add(x, hn::Set(di, 1)), x1);
        }
        y = hn::Min(hn::Add(y, hn::Set(di, 1)), y1);
    }
    return farthest;
}

// Tests a vector of quads, of which the first `count` count.
HWY_INLINE void testVector(const QuadTest& test, const Rows& rows, sh::Quad* quads, std::size_t count,
                           std::uint32_t firstNumber, bool isDrawnEarly, std::uint32_t* out,
                           QuadTestResult& result) {
    U word0, word1;
    auto* words = reinterpret_cast<std::uint32_t*>(quads);
    hn::LoadInterleaved2(du, words, word0, word1);
    const Bounds bounds = boundsOf(test, rows, word0, word1);
    const Mask isSoonInView =
        hn::AndNot(bounds.isBack, hn::And(isInView(test, bounds, sh::kSoonPixels), bounds.isBefore));
    Mask isVisible = hn::Not(bounds.isBefore), isSoon = isVisible;
    if (!hn::AllFalse(df, isSoonInView)) {
        const F farthest = farthestIn(*test.pyramid, test, bounds);
        const Mask isShown = hn::And(hn::And(isInView(test, bounds, 0), isSoonInView),
                                     hn::And(hasSample(test, bounds), hn::Ge(bounds.nearest, farthest)));
        isVisible = hn::Or(isVisible, isShown);
        isSoon =
            hn::Or(isSoon, hn::And(isSoonInView, hn::Ge(bounds.nearest, hn::Mul(set(sh::kSoon), farthest))));
    }
    const auto inUse = hn::RebindMask(df, hn::FirstN(du, count));
    const auto isSeen = hn::RebindMask(du, hn::And(inUse, hn::Or(isVisible, isSoon)));
    auto isNew = hn::RebindMask(du, hn::And(inUse, isVisible));
    const U seenBit = hn::Set(du, sh::kQuadSeen), newBit = hn::Set(du, sh::kQuadNew);
    if (isDrawnEarly) isNew = hn::And(isNew, hn::Eq(hn::And(word1, seenBit), hn::Zero(du)));
    word1 = hn::Or(hn::AndNot(hn::Or(seenBit, newBit), word1),
                   hn::Or(hn::IfThenElseZero(isSeen, seenBit), hn::IfThenElseZero(isNew, newBit)));
    hn::StoreInterleaved2(word0, word1, du, words);
    result.isAnySeen = result.isAnySeen || !hn::AllFalse(du, isSeen);
    result.newQuads += static_cast<std::uint32_t>(
        hn::CompressStore(hn::Iota(du, firstNumber), isNew, du, out + result.newQuads));
}

QuadTestResult testAll(const QuadTest& test, sh::Quad* quads, std::uint32_t first, std::uint32_t count,
                       bool isDrawnEarly, std::uint32_t* out) {
    constexpr std::size_t kMost = hn::MaxLanes(du);
    const std::size_t lanes = hn::Lanes(du);
    const Rows rows(test);
    QuadTestResult result;
    std::uint32_t k = 0;
    for (; k + lanes <= count; k += static_cast<std::uint32_t>(lanes))
        testVector(test, rows, quads + first + k, lanes, first + k, isDrawnEarly, out, result);
    if (k < count) {
        std::array<sh::Quad, kMost> rest{};
        std::copy_n(quads + first + k, count - k, rest.begin());
        testVector(test, rows, rest.data(), count - k, first + k, isDrawnEarly, out, result);
        std::copy_n(rest.begin(), count - k, quads + first + k);
    }
    return result;
}

std::uint32_t listAllSeen(const sh::Quad* quads, std::uint32_t first, std::uint32_t count,
                          std::uint32_t* out) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(du));
    std::uint32_t listed = 0, k = first;
    const std::uint32_t end = first + count;
    const U seen = hn::Set(du, sh::kQuadSeen);
    for (; k + lanes <= end; k += lanes) {
        U word0, word1;
        hn::LoadInterleaved2(du, reinterpret_cast<const std::uint32_t*>(quads + k), word0, word1);
        const auto isSeen = hn::Ne(hn::And(word1, seen), hn::Zero(du));
        listed += static_cast<std::uint32_t>(hn::CompressStore(hn::Iota(du, k), isSeen, du, out + listed));
    }
    for (; k < end; ++k)
        if ((quads[k].word1 & sh::kQuadSeen) != 0) out[listed++] = k;
    return listed;
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::render {

HWY_EXPORT(testAll);
HWY_EXPORT(listAllSeen);

QuadTestResult testQuads(const QuadTest& test, std::span<shared::Quad> arena, std::uint32_t first,
                         std::uint32_t count, bool isDrawnEarly, std::uint32_t* out) {
    return HWY_DYNAMIC_DISPATCH(testAll)(test, arena.data(), first, count, isDrawnEarly, out);
}

std::uint32_t listSeen(std::span<const shared::Quad> arena, std::uint32_t first, std::uint32_t count,
                       std::uint32_t* out) {
    return HWY_DYNAMIC_DISPATCH(listAllSeen)(arena.data(), first, count, out);
}

void DepthPyramid::resize(glm::ivec2 finest) {
    levels.clear();
    std::int32_t first = 0;
    for (glm::ivec2 size = finest;; size = (size + 1) / 2) {
        levels.push_back({first, size});
        first += size.x * size.y;
        if (size == glm::ivec2(1)) break;
    }
    texels.resize(static_cast<std::size_t>(first));
}

void DepthPyramid::build() {
    for (std::size_t k = 1; k < levels.size(); ++k) {
        const glm::ivec2 size = levels[k].size, finer = levels[k - 1].size;
        for (int y = 0; y < size.y; ++y) {
            const float* low = &texels[static_cast<std::size_t>(levels[k - 1].first + 2 * y * finer.x)];
            const float* high = 2 * y + 1 < finer.y ? low + finer.x : low;
            float* to = &texels[static_cast<std::size_t>(levels[k].first + y * size.x)];
            for (int x = 0; x < finer.x / 2; ++x)
                to[x] =
                    std::min(std::min(low[2 * x], low[2 * x + 1]), std::min(high[2 * x], high[2 * x + 1]));
            const int last = finer.x - 1;
            if (last % 2 == 0) to[last / 2] = std::min(low[last], high[last]);
        }
    }
}

float DepthPyramid::farthestIn(const shared::HiZArea& area) const {
    const Level& level = levels[static_cast<std::size_t>(area.level)];
    float farthest = 1;
    for (int y = area.first.y; y <= area.last.y; ++y) {
        const float* row = &texels[static_cast<std::size_t>(level.first + y * level.size.x)];
        for (int x = area.first.x; x <= area.last.x; ++x) farthest = std::min(farthest, row[x]);
    }
    return farthest;
}

}  // namespace terrane::render
#endif
