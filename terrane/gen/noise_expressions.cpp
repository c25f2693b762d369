#include "terrane/gen/noise_expressions.h"

#include "terrane/gen/expr_vec.h"

namespace terrane::gen {
namespace {

Int logicalShift(Int v, int bits) {
    return (v >> bits) & static_cast<std::int32_t>(~0u >> bits);
}

// k, the direction, are the upper four bits: two of the gradient in the first quadrant, two of the quadrant.
Vec2 gradient2(Int hash) {
    constexpr auto& g = kQuadrant;
    const Int k = logicalShift(hash, 28);
    const auto bit = [&](int n) { return (k & (1 << n)) != 0; };
    const auto pick = [&](float a, float b, float c, float d) {
        return select(bit(1), select(bit(0), Float(d), Float(c)), select(bit(0), Float(b), Float(a)));
    };
    const Float x = pick(g[0], g[1], g[2], g[3]), y = pick(g[3], g[2], g[1], g[0]);
    const Float turnedX = select(bit(2), -y, x), turnedY = select(bit(2), x, y);
    return {select(bit(3), -turnedX, turnedX), select(bit(3), -turnedY, turnedY)};
}

// The 12 vectors to the edges of a cube, in the planes xy, xz, yz.
Vec3 gradient3(Int hash) {
    const Int k = (logicalShift(hash, 16) * 12) >> 16;
    const Float first = select((k & 1) == 0, Float(1.0f), Float(-1.0f));
    const Float second = select((k & 2) == 0, Float(1.0f), Float(-1.0f));
    return {select(k < 8, first, Float(0.0f)), multiSelect({{k < 4, second}, {k < 8, Float(0.0f)}}, first),
            select(k < 4, Float(0.0f), second)};
}

// A value and how it changes along x, y and z.
struct Slope {
    Float value = 0.0f;
    std::array<Float, 3> along = {0.0f, 0.0f, 0.0f};
};

// Between a and b at the fraction `fade`, which changes by `fadeSlope` along `axis`.
Slope blend(const Slope& a, const Slope& b, Float fade, Float fadeSlope, std::size_t axis) {
    Slope result;
    result.value = lerp(a.value, b.value, fade);
    for (std::size_t k = 0; k < 3; ++k) result.along[k] = lerp(a.along[k], b.along[k], fade);
    result.along[axis] = result.along[axis] + fadeSlope * (b.value - a.value);
    return result;
}

struct LatticeAxis {
    Int cell;
    Float f, fade, fadeSlope;
};

LatticeAxis latticeAxis(Int position, std::int32_t size) {
    const Int cell = floorDivide(position, size);
    const Float f = Float(position - cell * size) * (1.0f / static_cast<float>(size));
    return {cell, f, ((f * f) * f) * (f * (f * 6.0f - 15.0f) + 10.0f),
            30.0f * (f * f) * (f * (f - 2.0f) + 1.0f)};
}

}  // namespace

std::array<Float, 3> perlinGradient(std::span<const Int> position, std::int32_t size,
                                    const LatticeHash& hash) {
    const std::size_t dimensions = position.size();
    std::vector<LatticeAxis> axes;
    for (const Int& p : position) axes.push_back(latticeAxis(p, size));
    // Corners by the bits of their number, x first; then halved axis by axis.
    std::vector<Slope> slopes(std::size_t{1} << dimensions);
    for (std::size_t corner = 0; corner < slopes.size(); ++corner) {
        std::vector<Int> node;
        std::vector<Float> offset;
        for (std::size_t k = 0; k < dimensions; ++k) {
            const bool isUpper = (corner >> k & 1) != 0;
            node.push_back(axes[k].cell + (isUpper ? 1 : 0));
            offset.push_back(isUpper ? axes[k].f - 1.0f : axes[k].f);
        }
        const Int bits = hash(node);
        const Vec2 flat = gradient2(bits);
        const Vec3 solid = dimensions == 3 ? gradient3(bits) : Vec3{flat.x, flat.y, 0.0f};
        slopes[corner].along = {solid.x, solid.y, solid.z};
        for (std::size_t k = 0; k < dimensions; ++k) {
            slopes[corner].value = slopes[corner].value + slopes[corner].along[k] * offset[k];
        }
    }
    for (std::size_t k = 0; k < dimensions; ++k) {
        for (std::size_t pair = 0; pair < slopes.size() / 2; ++pair) {
            slopes[pair] = blend(slopes[2 * pair], slopes[2 * pair + 1], axes[k].fade, axes[k].fadeSlope, k);
        }
        slopes.resize(slopes.size() / 2);
    }
    const float perBlock = 1.0f / static_cast<float>(size);
    return {slopes[0].along[0] * perBlock, slopes[0].along[1] * perBlock, slopes[0].along[2] * perBlock};
}

Float simplex3D(Int x, Int y, Int z, std::int32_t size, const LatticeHash& hash) {
    constexpr std::int32_t kPeriod = 3;
    constexpr float kSkew = 1.0f / 3.0f, kUnskew = 1.0f / 6.0f;
    constexpr float kScale = 76.8f;  // one over the largest sum any gradients can give
    const Int position[] = {x, y, z};
    const float inverseSize = 1.0f / static_cast<float>(size);
    Int period[3] = {0, 0, 0}, cell[3] = {0, 0, 0};
    Float f[3] = {0.0f, 0.0f, 0.0f}, o[3] = {0.0f, 0.0f, 0.0f};
    for (std::size_t k = 0; k < 3; ++k) {
        period[k] = floorDivide(position[k], kPeriod * size);
        f[k] = Float(position[k] - period[k] * (kPeriod * size)) * inverseSize;
    }
    const Float skew = ((f[0] + f[1]) + f[2]) * kSkew;
    const Float i[] = {floor(f[0] + skew), floor(f[1] + skew), floor(f[2] + skew)};
    const Float unskew = ((i[0] + i[1]) + i[2]) * kUnskew;
    const Int shift = period[0] + period[1] + period[2];
    for (std::size_t k = 0; k < 3; ++k) {
        o[k] = f[k] - (i[k] - unskew);
        cell[k] = period[k] * kPeriod + shift + Int(i[k]);
    }

    const auto corner = [&](std::array<Int, 3> d, float unskewed) {
        const Float ox = o[0] - Float(d[0]) + unskewed, oy = o[1] - Float(d[1]) + unskewed;
        const Float oz = o[2] - Float(d[2]) + unskewed;
        const Float t = max(0.5f - ((ox * ox + oy * oy) + oz * oz), Float(0.0f));
        const Int node[] = {cell[0] + d[0], cell[1] + d[1], cell[2] + d[2]};
        const Vec3 g = gradient3(hash(node));
        return ((t * t) * (t * t)) * ((g.x * ox + g.y * oy) + g.z * oz);
    };
    // The simplex is the one whose corners go along the axes in the order of the offsets.
    const Bool xy = o[0] >= o[1], xz = o[0] >= o[2], yz = o[1] >= o[2];
    const auto one = [](Bool b) { return select(b, Int(1), Int(0)); };
    const Float first = corner({one(xy && xz), one(!xy && yz), one(!xz && !yz)}, kUnskew);
    const Float second = corner({one(xy || xz), one(!xy || yz), one(!xz || !yz)}, 2.0f * kUnskew);
    return kScale * ((corner({0, 0, 0}, 0.0f) + first) + (second + corner({1, 1, 1}, 3.0f * kUnskew)));
}

}  // namespace terrane::gen
