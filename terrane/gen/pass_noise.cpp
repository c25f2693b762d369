// The noise calls and random numbers of a pass.
#include "terrane/gen/builder.h"
#include "terrane/gen/noise_expressions.h"
#include "terrane/gen/pass.h"
#include "terrane/gen/voronoi_mean.h"

namespace terrane::gen {
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
