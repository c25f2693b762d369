// Methods of passes: noise, random numbers, scatter, erosion.
#include "terrane/gen/language/compounds.h"
#include "terrane/lua/graph_call_internal.h"

namespace terrane::lua {
namespace {

using gen::Float;
using gen::Int;

constexpr int kMaxErosionOctaves = 8;

// Steps to record an octave of a noise that is many operations.
constexpr std::int64_t kStepsOfOctave = 1'500;

// Records a noise that is made of octaves. Arguments: name, size, weights.
template <class T>
int octaves(GraphCall& c, T (gen::Pass::*noise)(std::string_view, int, std::vector<float>),
            std::int64_t stepsOfOctave = 0) {
    const std::string name(c.name(1));
    const int size = c.size(2);
    const std::vector<float> weights = c.weights(3);
    c.charge(stepsOfOctave * static_cast<std::int64_t>(weights.size()));
    return c.push((c.pass().*noise)(name, size, weights));
}

// clang-format off
int perlin2D(GraphCall& c) { return octaves(c, &gen::Pass::perlin2D); }
int perlin3D(GraphCall& c) { return octaves(c, &gen::Pass::perlin3D); }
int perlin2DWithGrain(GraphCall& c) { return octaves(c, &gen::Pass::perlin2DWithGrain); }
int perlin2DGradient(GraphCall& c) { return octaves(c, &gen::Pass::perlin2DGradient, kStepsOfOctave); }
int perlin3DGradient(GraphCall& c) { return octaves(c, &gen::Pass::perlin3DGradient, kStepsOfOctave); }
int simplex2D(GraphCall& c) { return octaves(c, &gen::Pass::simplex2D); }
int simplex3D(GraphCall& c) { return octaves(c, &gen::Pass::simplex3D, kStepsOfOctave); }
int grain(GraphCall& c) { return c.push(c.pass().grain(c.name(1))); }
int grain2D(GraphCall& c) { return c.push(c.pass().grain2D(c.name(1))); }
// clang-format on

int stripes2D(GraphCall& c) {
    const gen::Stripes2D stripes = c.pass().stripes2D(c.name(1), c.size(2), c.get<gen::Vec2>(3));
    lua_createtable(c.L, 0, 2);
    c.set("cosine", stripes.cosine);
    c.set("sine", stripes.sine);
    return 1;
}

template <class Voronoi>
int pushVoronoi(GraphCall& c, const Voronoi& voronoi) {
    lua_createtable(c.L, 0, 3);
    c.set("distance", voronoi.distance);
    c.set("ratio", voronoi.ratio);
    c.set("offset", voronoi.offset);
    return 1;
}

int voronoi2D(GraphCall& c) {
    return pushVoronoi(c, c.pass().voronoi2D(c.name(1), c.size(2), c.integer(3)));
}

int voronoi3D(GraphCall& c) {
    const int exponent = c.isMissing(4) ? 2 : c.integer(4);
    return pushVoronoi(c, c.pass().voronoi3D(c.name(1), c.size(2), c.integer(3), exponent));
}

int drainageHere(GraphCall& c) {
    const gen::DrainageSample s = c.pass().drainage({c.object(1, Tag::Drainage).number});
    lua_createtable(c.L, 0, 7);
    c.set("distance", s.distance);
    c.set("fall", s.fall);
    c.set("halfWidth", s.halfWidth);
    c.set("level", s.level);
    c.set("flow", s.flow);
    c.set("lakeDistance", s.lakeDistance);
    c.set("lakeLevel", s.lakeLevel);
    return 1;
}

int valleysHere(GraphCall& c) {
    const gen::ValleySample s = c.pass().valleys({c.object(1, Tag::Drainage).number});
    lua_createtable(c.L, 0, 3);
    c.set("distance", s.distance);
    c.set("level", s.level);
    c.set("flow", s.flow);
    return 1;
}

// Reads coordinates from argument `first` on. Where they are missing, the position of the column or voxel.
std::array<Int, 3> position(GraphCall& c, int first, bool is3D) {
    gen::Pass& p = c.pass();
    if (c.isMissing(first)) return {p.x(), p.y(), is3D ? p.z() : Int(0)};
    return {c.get<Int>(first), c.get<Int>(first + 1), is3D ? c.get<Int>(first + 2) : Int(0)};
}

int random2D(GraphCall& c) {
    const auto at = position(c, 2, false);
    return c.push(c.pass().random2D(c.name(1), at[0], at[1]));
}

int random3D(GraphCall& c) {
    const auto at = position(c, 2, true);
    return c.push(c.pass().random3D(c.name(1), at[0], at[1], at[2]));
}

int randomBool2D(GraphCall& c) {
    const auto at = position(c, 3, false);
    return c.push(c.pass().randomBool2D(c.name(1), c.get<Float>(2), at[0], at[1]));
}

int randomBool3D(GraphCall& c) {
    const auto at = position(c, 3, true);
    return c.push(c.pass().randomBool3D(c.name(1), c.get<Float>(2), at[0], at[1], at[2]));
}

int scatter(GraphCall& c) {
    const int spacing = c.integer(2, 1, gen::kMaxScatterSpacing), least = c.integer(3, 1, spacing);
    c.charge(kStepsOfOctave);
    const gen::ScatterPoint point = gen::scatter(c.pass(), c.name(1), spacing, least);
    lua_createtable(c.L, 0, 3);
    c.set("isHere", point.isHere);
    c.set("at", point.at);
    c.set("hash", point.hash);
    return 1;
}

int erode(GraphCall& c) {
    gen::Erosion erosion;
    if (!c.isMissing(4)) {
        readOptions(c, 4,
                    {{"size", &erosion.size},
                     {"octaves", &erosion.octaves},
                     {"depth", &erosion.depth},
                     {"fullSlope", &erosion.fullSlope},
                     {"gain", &erosion.gain}});
    }
    if (erosion.octaves < 1 || erosion.octaves > kMaxErosionOctaves)
        fail("erode: octaves {} is not in 1…{}", erosion.octaves, kMaxErosionOctaves);
    if (erosion.size >> (erosion.octaves - 1) < 1 || erosion.size > 65536)
        fail("erode: size {} is too small for {} octaves, or beyond 65536", erosion.size, erosion.octaves);
    if (!(erosion.fullSlope > 0.0f)) fail("erode: fullSlope {} is not above 0", erosion.fullSlope);
    c.charge(kStepsOfOctave * erosion.octaves);
    const gen::Eroded eroded = gen::erode(c.pass(), c.name(1), c.get<gen::Vec2>(2), c.get<Float>(3), erosion);
    lua_createtable(c.L, 0, 2);
    c.set("height", eroded.height);
    c.set("ridge", eroded.ridge);
    return 1;
}

constexpr GraphFunction kNoiseMethods[] = {{"perlin2D", perlin2D},
                                           {"perlin3D", perlin3D},
                                           {"perlin2DWithGrain", perlin2DWithGrain},
                                           {"perlin2DGradient", perlin2DGradient},
                                           {"perlin3DGradient", perlin3DGradient},
                                           {"simplex2D", simplex2D},
                                           {"simplex3D", simplex3D},
                                           {"grain", grain},
                                           {"grain2D", grain2D},
                                           {"stripes2D", stripes2D},
                                           {"voronoi2D", voronoi2D},
                                           {"voronoi3D", voronoi3D},
                                           {"drainage", drainageHere},
                                           {"valleys", valleysHere},
                                           {"random2D", random2D},
                                           {"random3D", random3D},
                                           {"randomBool2D", randomBool2D},
                                           {"randomBool3D", randomBool3D},
                                           {"scatter", scatter},
                                           {"erode", erode}};

}  // namespace

std::span<const GraphFunction> noiseMethods() {
    return kNoiseMethods;
}

}  // namespace terrane::lua
