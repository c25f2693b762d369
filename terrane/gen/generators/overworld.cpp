// The overworld: seas with beaches and islands, rivers at sea level, plains, hills, deserts with dunes,
// mountain ranges with snow, caves, ore, trees and plants.
#include "terrane/gen/generators/overworld.h"

#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

void writeOverworld(GeneratorBuilder& g) {
    const overworld::Fields f(g);
    g.pass2D("climate", [&](Pass& p) { climatePass(p, f); });
    g.pass2D("relief", [&](Pass& p) { reliefPass(p, f); });
    g.pass2D("surface", [&](Pass& p) { surfacePass(p, f); });
    if (g.step() > 1) return g.pass3D("far", [&](Pass& p) { farPass(p, f); });
    // Before the 3D passes: neighbors need the positions of trees, and run no later pass for each other.
    g.pass2D("plants", [&](Pass& p) { plantsPass(p, f); });
    g.pass3D("ground", [&](Pass& p) { groundPass(p, f); });
    g.pass3D("vegetation", [&](Pass& p) { vegetationPass(p, f); });
}

}  // namespace terrane::gen
