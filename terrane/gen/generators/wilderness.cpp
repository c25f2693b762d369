#include "terrane/gen/generators/wilderness.h"

#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

// Wilderness: tall land. Rivers come first: the ground rises from them as rivers that cut into rising land
// leave it, with ranges of 1,700 blocks, fjords, canyons, volcanoes and a sea 400 deep.

namespace wilderness {

const char* biomeName(Biome biome) {
    constexpr const char* kNames[] = {
        "deep ocean",   "ocean",         "kelp forest",  "reef",       "beach",        "stony shore",
        "mangrove",     "meadow",        "steppe",       "oak forest", "beech forest", "birch forest",
        "maple forest", "old forest",    "giant forest", "swamp",      "bog",          "taiga",
        "fir forest",   "larch forest",  "tundra",       "snow",       "glacier",      "alpine meadow",
        "rocks",        "savanna",       "shrubland",    "desert",     "badlands",     "rain forest",
        "cloud forest", "bamboo forest", "cherry grove", "lava field"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(Biome::Count));
    return kNames[static_cast<std::size_t>(biome)];
}

Fields::Fields(GeneratorBuilder& g)
    : land(g.field<Float>("land")),
      range(g.field<Float>("range")),
      hilly(g.field<Float>("hilly")),
      table(g.field<Float>("table")),
      rangeLine(g.field<Float>("range line")),
      temperature(g.field<Float>("temperature")),
      rain(g.field<Float>("rain")),
      moisture(g.field<Float>("moisture")),
      canyon(g.field<Float>("canyon")),
      volcanic(g.field<Float>("volcanic")),
      craterLake(g.field<Int>("crater lake")),
      isLava(g.field<Bool>("is lava")),
      base(g.field<Float>("base")),
      fan(g.field<Float>("fan")),
      fromStream(g.field<Float>("from stream")),
      streamLevel(g.field<Float>("stream level")),
      sides(g.field<Float>("sides")),
      height(g.field<Float>("height")),
      rocky(g.field<Float>("rocky")),
      wet(g.field<Float>("wet")),
      water(g.field<Int>("water")),
      fall(g.field<Int>("fall")),
      surface(g.field<Int>("surface")),
      placeKind(g.field<Int>("place")),
      placeX(g.field<Int>("place x")),
      placeY(g.field<Int>("place y")),
      spring(g.field<Float>("spring")),
      biome(g.field<Int>("biome")),
      cold(g.field<Float>("cold")),
      forest(g.field<Float>("forest")),
      top(g.field<Block>("top")),
      soil(g.field<Block>("soil")),
      rock(g.field<Block>("rock")),
      color(g.field<Int>("color")),
      rivers(wilderness::rivers(g)),
      plants(g, vegetationTables()),
      ruins(ruins::record(g)) {
    if (g.step() <= kMaxArchStep) {
        archLow = g.field<Int>("arch low");
        archHigh = g.field<Int>("arch high");
    }
    if (g.step() <= kMaxNotchStep) {
        notchLow = g.field<Int>("notch low");
        notchHigh = g.field<Int>("notch high");
    }
    (g.step() == 1 ? caveTop : hidden) = g.field<Int>(g.step() == 1 ? "cave top" : "hidden");
    if (g.step() == 1) caves.emplace(g);
}

}  // namespace wilderness

void writeWilderness(GeneratorBuilder& g) {
    using namespace wilderness;
    g.declareHeights({-512, 1792});
    const Fields f(g);
    g.pass2D("forms", [&](Pass& p) { formsPass(p, f); });
    g.pass2D("base", [&](Pass& p) { basePass(p, f); });
    g.pass2D("color", [&](Pass& p) { colorPass(p, f); });
    g.tint(f.color);
    g.pass2D("relief", [&](Pass& p) { reliefPass(p, f); });
    g.pass2D("surface", [&](Pass& p) { surfacePass(p, f); });
    g.pass2D("plants", [&](Pass& p) { plantsPass(p, f); });
    if (g.step() <= kMaxArchStep) g.pass2D("arches", [&](Pass& p) { archesPass(p, f); });
    if (g.step() == 1) g.pass2D("underground", [&](Pass& p) { underSurfacePass(p, f); });
    g.pass3D("land", [&](Pass& p) { p.setBlock(landBlock(p, f)); });
    if (g.step() == 1) g.pass3D("cave life", [&](Pass& p) { caveLifePass(p, f); });
}

}  // namespace terrane::gen
