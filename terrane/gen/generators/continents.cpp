// Continents: ranges with spurs and gullies, plains, table lands and canyons, dunes, karst, volcanoes, rivers
// from range to sea, and sixteen biomes in belts of climate.
#include "terrane/gen/generators/continents.h"

#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

namespace continents {

const char* biomeName(Biome biome) {
    constexpr const char* kNames[] = {
        "ocean",  "reef", "beach",   "meadow", "oak forest",  "birch forest", "old forest", "taiga",
        "tundra", "snow", "savanna", "desert", "canyon land", "swamp",        "alpine",     "rain forest"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(Biome::Count));
    return kNames[static_cast<std::size_t>(biome)];
}

}  // namespace continents

void writeContinents(GeneratorBuilder& g) {
    const continents::Fields f(g);
    g.pass2D("shape", [&](Pass& p) { shapePass(p, f); });
    g.pass2D("color", [&](Pass& p) { colorPass(p, f); });
    g.tint(f.color);
    g.pass2D("relief", [&](Pass& p) { reliefPass(p, f); });
    g.pass2D("surface", [&](Pass& p) { surfacePass(p, f); });
    g.pass2D("plants", [&](Pass& p) { plantsPass(p, f); });
    g.pass3D("land", [&](Pass& p) { landPass(p, f); });
    if (g.step() == 1) g.pass3D("cave life", [&](Pass& p) { caveLifePass(p, f); });
}

}  // namespace terrane::gen
