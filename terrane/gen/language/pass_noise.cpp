#include "terrane/gen/language/pass_noise.h"

#include "terrane/gen/language/builder.h"
#include "terrane/gen/language/compounds.h"
#include "terrane/gen/language/expr.h"
#include "terrane/gen/language/pass.h"

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

// The noise calls and random numbers of a pass.

namespace {

// The root of a sum of powers.
Float metricRoot(Float sum, int exponent) {
    if (exponent == 2) return sqrt(sum);
    if (exponent == 4) return sqrt(sqrt(sum));
    return pow(sum, 1.0f / static_cast<float>(exponent));
}

// Calls use(octave, size of its cells, weight) for each octave that has one.
template <class Use>
void forEachOctave(const NoiseCall& call, Use use) {
    for (std::size_t o = 0; o < call.weights.size(); ++o) {
        if (call.weights[o] != 0.0f) use(o, call.size << o, call.weights[o]);
    }
}

NoiseCall octaveNoise(NoiseKind kind, std::string_view name, int size, std::vector<float> weights) {
    return {kind, std::string(name), size, std::move(weights)};
}

}  // namespace

NoiseCall Pass::checkedNoise(std::string_view kind, NoiseCall call) {
    return generator_.checkedNoise(*this, kind, std::move(call));
}

Value Pass::noise(const NoiseCall& call, std::uint32_t result, Type type) {
    const std::uint32_t index = generator_.noiseIndex(call);
    const std::uint8_t dependence = gen::is3D(call.kind) ? kDependsVoxel : kDependsColumn;
    return applyOp(Op::Component, type, {leaf(Op::Noise, Type::Float, index, dependence)}, result);
}

Float Pass::sumOfOctaves(const NoiseCall& call) {
    return hasOctaves(call) ? Float(noise(call, 0, Type::Float)) : Float(0.0f);
}

Float Pass::perlin2D(std::string_view name, int size, std::vector<float> weights) {
    const auto call = octaveNoise(NoiseKind::Perlin2D, name, size, std::move(weights));
    return sumOfOctaves(checkedNoise("Perlin 2D", call));
}

Float Pass::perlin3D(std::string_view name, int size, std::vector<float> weights) {
    if (!require3D("perlin3D")) return 0.0f;
    const auto call = octaveNoise(NoiseKind::Perlin3D, name, size, std::move(weights));
    return sumOfOctaves(checkedNoise("Perlin 3D", call));
}

Int Pass::hash(const std::string& seedName, std::uint32_t octave, std::span<const Int> position) {
    const std::uint32_t seed = packHashSeed(generator_.hashSlot(seedName), octave);
    std::vector<NodeId> args;
    for (const Int& p : position) args.push_back(p.nodeIn(graph_.graph, Type::Int));
    const Op op = args.size() == 2 ? Op::Hash2 : Op::Hash3;
    return Int(Value{&graph_.graph, graph_.graph.add(op, Type::Int, args, seed)});
}

LatticeHash Pass::latticeHash(const NoiseCall& call, std::size_t octave) {
    return [this, seed = noiseSeedName(call.name), octave](std::span<const Int> node) {
        return hash(seed, static_cast<std::uint32_t>(octave), node);
    };
}

std::array<Float, 3> Pass::gradient(const NoiseCall& call, std::span<const Int> position) {
    std::array<Float, 3> sum = {0.0f, 0.0f, 0.0f};
    forEachOctave(call, [&](std::size_t octave, int cellSize, float weight) {
        const auto slope = perlinGradient(position, cellSize, latticeHash(call, octave));
        for (std::size_t k = 0; k < 3; ++k) sum[k] = sum[k] + slope[k] * weight;
    });
    return sum;
}

Vec2 Pass::perlin2DGradient(std::string_view name, int size, std::vector<float> weights) {
    const auto call = octaveNoise(NoiseKind::Perlin2D, name, size, std::move(weights));
    const Int position[] = {x(), y()};
    const auto sum = gradient(checkedNoise("Perlin 2D", call), position);
    return {sum[0], sum[1]};
}

Vec3 Pass::perlin3DGradient(std::string_view name, int size, std::vector<float> weights) {
    if (!require3D("perlin3DGradient")) return {0.0f, 0.0f, 0.0f};
    const auto call = octaveNoise(NoiseKind::Perlin3D, name, size, std::move(weights));
    const Int position[] = {x(), y(), z()};
    const auto sum = gradient(checkedNoise("Perlin 3D", call), position);
    return {sum[0], sum[1], sum[2]};
}

Float Pass::simplex2D(std::string_view name, int size, std::vector<float> weights) {
    const auto call = octaveNoise(NoiseKind::Simplex2D, name, size, std::move(weights));
    return sumOfOctaves(checkedNoise("simplex 2D", call));
}

Stripes2D Pass::stripes2D(std::string_view name, int size, Vec2 direction) {
    const NoiseCall call = checkedNoise("stripes 2D", {NoiseKind::Stripes2D, std::string(name), size, {}});
    if (call.size < step()) return {0.0f, 0.0f};
    const NodeId across[] = {direction.x.nodeIn(graph_.graph, Type::Float),
                             direction.y.nodeIn(graph_.graph, Type::Float)};
    const std::uint32_t index = generator_.noiseIndex(call);
    const Value stripes{&graph_.graph,
                        graph_.graph.add(Op::Stripes, Type::Float, across, index, kDependsColumn)};
    const auto result = [&](StripeResult r) {
        return Float(applyOp(Op::Component, Type::Float, {stripes}, r));
    };
    return {result(kStripeCos), result(kStripeSin)};
}

Float Pass::simplex3D(std::string_view name, int size, std::vector<float> weights) {
    if (!require3D("simplex3D")) return 0.0f;
    const auto call =
        checkedNoise("simplex 3D", octaveNoise(NoiseKind::Perlin3D, name, size, std::move(weights)));
    Float sum = 0.0f;
    forEachOctave(call, [&](std::size_t octave, int cellSize, float weight) {
        sum = sum + gen::simplex3D(x(), y(), z(), cellSize, latticeHash(call, octave)) * weight;
    });
    return sum;
}

Voronoi2D Pass::voronoi2D(std::string_view name, int size, int maxPoints) {
    const NoiseCall call =
        checkedNoise("Voronoi 2D", {NoiseKind::Voronoi2D, std::string(name), size, {}, maxPoints});
    if (call.size < step()) {
        const VoronoiMean mean = voronoiMean2D(call.maxPoints);
        return {mean.distance * static_cast<float>(call.size), mean.ratio, {0, 0}};
    }
    const auto number = [&](VoronoiResult r) { return Float(noise(call, r, Type::Float)); };
    const auto blocks = [&](VoronoiResult r) { return Int(noise(call, r, Type::Int)); };
    return {
        number(kVoronoiDistance), number(kVoronoiRatio), {blocks(kVoronoiOffsetX), blocks(kVoronoiOffsetY)}};
}

Voronoi3D Pass::voronoi3D(std::string_view name, int size, int maxPoints, int exponent) {
    if (!require3D("voronoi3D")) return {0.0f, 0.0f, {0, 0, 0}};
    const NoiseCall call =
        checkedNoise("Voronoi 3D", {NoiseKind::Voronoi3D, std::string(name), size, {}, maxPoints, exponent});
    if (call.size < step()) {
        const VoronoiMean mean = voronoiMean3D(call.maxPoints, call.exponent);
        return {mean.distance * static_cast<float>(call.size), mean.ratio, {0, 0, 0}};
    }
    const auto root = [&](Voronoi3DResult r) {
        return metricRoot(Float(noise(call, r, Type::Float)), call.exponent);
    };
    const auto blocks = [&](Voronoi3DResult r) { return Int(noise(call, r, Type::Int)); };
    const Float nearest = root(kVoronoi3DNearest), second = root(kVoronoi3DSecond);
    // Two points may lie in one block.
    constexpr float kMin = 1e-6f;
    return {nearest * static_cast<float>(call.size),
            nearest / max(second, Float(kMin)),
            {blocks(kVoronoi3DOffsetX), blocks(kVoronoi3DOffsetY), blocks(kVoronoi3DOffsetZ)}};
}

namespace {

// The upper 24 bits of a hash as a fraction.
Float fraction(Int hash) {
    return Float((hash >> 8) & 0xFFFFFF) * 0x1p-24f;
}

}  // namespace

Float Pass::random2D(std::string_view name, Int px, Int py) {
    const Int position[] = {px, py};
    return fraction(hash(randomSeedName(name), 0, position));
}

Float Pass::random3D(std::string_view name, Int px, Int py, Int pz) {
    const Int position[] = {px, py, pz};
    return fraction(hash(randomSeedName(name), 0, position));
}

Bool Pass::randomBool2D(std::string_view name, Float probability, Int px, Int py) {
    return random2D(name, px, py) < probability;
}

Bool Pass::randomBool3D(std::string_view name, Float probability, Int px, Int py, Int pz) {
    return random3D(name, px, py, pz) < probability;
}

}  // namespace terrane::gen
