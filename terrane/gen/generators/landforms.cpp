#include "terrane/gen/generators/landforms.h"

#include "terrane/gen/language/compounds.h"

namespace terrane::gen::landforms {

Float terraces(Float height, float rise, float steepness) {
    const Float steps = height * (1.0f / rise);
    const Float whole = floor(steps), part = steps - whole;
    return (whole + smoothstep(0.5f - 0.5f / steepness, 0.5f + 0.5f / steepness, part)) * rise;
}

Float tables(Pass& p) {
    const Float tables = p.simplex2D("tables", 32, {.04f, .10f, .25f, .6f, 1.0f});
    const Float canyons = abs(p.simplex2D("canyons", 64, {.06f, .15f, .45f, 1.0f}));
    const Float high = smoothstep(-0.35f, 0.75f, tables) * 78.0f;
    return terraces(high, 15.0f, 4.5f) * smoothstep(0.02f, 0.2f, canyons) + 4.0f;
}

Float dunes(Pass& p) {
    constexpr int kSize = 80;
    const float left = shareLeft(kSize, p.step());
    const Float bend = p.simplex2D("wind", 256, {.5f, 1.0f}) * 0.35f;
    const Stripes2D wave = p.stripes2D("dunes", kSize, {1.0f - bend * bend * 0.5f, bend});
    const Float crest = wave.cosine * 0.5f + 0.5f;
    const Float lee = max(wave.sine, Float(0.0f)) * crest * 0.5f;
    const Float large = smoothstep(-0.3f, 0.6f, p.simplex2D("dune sizes", 256, {.5f, 1.0f}));
    return lerp(Float(0.4f), crest * crest - lee + 0.1f, left) * (large * 15.0f + 3.0f);
}

Float towers(Pass& p) {
    constexpr int kSize = 72;
    const float left = shareLeft(kSize, p.step());
    const Voronoi2D cell = p.voronoi2D("towers", kSize, 1);
    const Float radius = p.simplex2D("tower sizes", 128, {.5f, 1.0f}) * 9.0f + 23.0f;
    const Float near = clamp(1.0f - cell.distance / radius, 0.0f, 1.0f);
    const Float tower = smoothstep(0.0f, 0.35f, near) * 0.7f + near * 0.3f;
    return lerp(Float(0.2f), tower, left) * (radius * 2.1f);
}

}  // namespace terrane::gen::landforms
