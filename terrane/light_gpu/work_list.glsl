// Light tiles that may change in a round, and which light tiles lie beside each other. Two lists take turns; a round's dispatch
// has a work group for each entry.
#include "terrane/light_gpu/solver_state.glsl"

layout(std430, binding = kSolverTilesBinding) readonly buffer Tiles {
    uint tiles[];  // what kTileIs… says
};
layout(std430, binding = kSolverListsBinding) buffer Lists {
    uint lists[];  // two lists of light tiles, then for each light tile the last round that it was put down for
};
layout(std430, binding = kSolverNeighborsBinding) readonly buffer Neighbors {
    uvec4 neighbors[];  // by chunk: those at −x, +x, −y, +y, or kNoChunk
};

const uint kNoCell = 0xFFFFFFFFu;

// The light tile beyond a side: −x, +x, −y, +y, −z, +z; kNoCell where nothing is known.
uint cellBeside(uint tile, uint side) {
    bool isUp = (side & 1u) != 0u;
    if (side >= 4u) {
        uint z = tile >> 2 & (kLightTilesHigh - 1u);
        if (z == (isUp ? kLightTilesHigh - 1u : 0u)) return kNoCell;
        return isUp ? tile + 4u : tile - 4u;
    }
    uint axis = side >> 1, other = tile ^ 1u << axis;
    if (isUp == ((tile >> axis & 1u) == 0u)) return other;  // of the same chunk
    uint chunk = neighbors[tile / kLightTilesPerChunk][side];
    return chunk == kNoChunk ? kNoCell : chunk * kLightTilesPerChunk + other % kLightTilesPerChunk;
}

uint tileOfList(uint list, uint entry) {
    return lists[(list & 1u) * tileCount() + entry];
}

void addToList(uint list, uint tile) {
    lists[(list & 1u) * tileCount() + atomicAdd(rounds[list].groupsX, 1u)] = tile;
}

// Whether light of `from` could raise that of `to`, a block of the least opacity beside it.
bool couldRaise(uint from, uint to) {
    return maxLevels(lessLevels(from, 0x01010101u), to) != to;
}
