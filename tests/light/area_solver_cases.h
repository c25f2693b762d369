// Requirements on every back end of AreaSolver, tested against the equation itself.
#pragma once

#include <string>

#include "terrane/light/light_area.h"
#include "tests/light/reference_light.h"
#include "tests/support/default_heights.h"

namespace terrane::light {

inline void expectSolves(AreaSolver& solver, const TestArea& area, int height = kFilledHeight + 16) {
    expectReference(area, area.flatten(solver.solve(area.view())), height);
}

inline void expectRandomWorlds(AreaSolver& solver) {
    for (std::uint32_t seed = 60; seed < 62; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        expectSolves(solver, TestArea(1, 1, scattered(seed, 1)));
        expectSolves(solver, TestArea(1, 1, scattered(seed, 8)));
        expectSolves(solver, TestArea(1, 1, layers(seed)));
        expectSolves(solver, TestArea(1, 2, caves(seed)));
        expectSolves(solver, TestArea(2, 1, scattered(seed, 60)));
        if (testing::Test::HasFailure()) return;
    }
    expectSolves(solver, TestArea(2, 2, caves(63)));
}

// Sections of one value: open sky, solid ground, water, and lamps at the bottom and the top of the world.
inline void expectPlainWorlds(AreaSolver& solver) {
    const world::BlockId stone = contentBlock("stone"), water = contentBlock("water"),
                         lamp = contentBlock("lamp_green");
    expectSolves(solver, TestArea(1, 1, [](int, int, int) { return world::kAir; }));
    expectSolves(solver, TestArea(1, 1, [&](int, int, int z) { return z < 32 ? stone : world::kAir; }));
    expectSolves(solver, TestArea(1, 1, [&](int, int, int z) { return z < 48 ? water : world::kAir; }));
    expectSolves(solver, TestArea(1, 1, [&](int, int, int z) { return z < 16 ? lamp : world::kAir; }));
    const TestArea ends(1, 2, [&](int x, int y, int z) {
        return x == 8 && y == 16 && (z == 0 || z == 255) ? lamp : z == 128 ? stone : world::kAir;
    });
    expectSolves(solver, ends, world::kChunkHeight);
}

// Opaque blocks that emit light into otherwise uniform dark sections.
inline void expectLampsInWalls(AreaSolver& solver) {
    const world::BlockId stone = contentBlock("stone"), ore = contentBlock("glowing_ore"),
                         lamp = contentBlock("lamp_blue");
    expectSolves(solver, TestArea(2, 2, [&](int x, int y, int z) {
                     if (z >= 24 && z < 34) return world::kAir;
                     if (z >= kFilledHeight) return world::kAir;
                     if (z == 23 && x == 16 && y == 15) return lamp;
                     return z == 34 && x % 9 == 0 && y % 7 == 0 ? ore : stone;
                 }));
}

inline void expectSolverCases(AreaSolver& solver) {
    expectRandomWorlds(solver);
    expectPlainWorlds(solver);
    expectLampsInWalls(solver);
}

}  // namespace terrane::light
