// Work lists of light tiles that may change in a round, and the neighbors of light tiles. Two lists take turns; the
// dispatch of a round has a work group for each entry.
#include "terrane/light_gpu/solver_state.glsl"

layout(std430, binding = kSolverTilesBinding) readonly buffer Tiles {
    uint tiles[];  // summaries: see kTileIsUniform
};
layout(std430, binding = kSolverListsBinding) buffer Lists {
    uint lists[];  // two lists of light tiles, then the last round that each light tile was listed for
};
layout(std430, binding = kSolverNeighborsBinding) readonly buffer Neighbors {
    uvec4 neighbors[];  // by chunk: neighbors at −x, +x, −y, +y, or kNoChunk
};

const uint kNoTile = 0xFFFFFFFFu;

// Light tile beyond a side: −x, +x, −y, +y, −z, +z; kNoTile if unknown.
uint tileBeside(uint tile, uint side) {
    bool isUp = (side & 1u) != 0u;
    if (side >= 4u) {
        uint z = tile >> 2 & (kLightTilesHigh - 1u);
        if (z == (isUp ? kLightTilesHigh - 1u : 0u)) return kNoTile;
        return isUp ? tile + 4u : tile - 4u;
    }
    uint axis = side >> 1, other = tile ^ 1u << axis;
    if (isUp == ((tile >> axis & 1u) == 0u)) return other;  // of the same chunk
    uint chunk = neighbors[tile / kLightTilesPerChunk][side];
    return chunk == kNoChunk ? kNoTile : chunk * kLightTilesPerChunk + other % kLightTilesPerChunk;
}

uint tileOfList(uint list, uint entry) {
    return lists[(list & 1u) * tileCount() + entry];
}

void addToList(uint list, uint tile) {
    lists[(list & 1u) * tileCount() + atomicAdd(rounds[list].groupsX, 1u)] = tile;
}

// Whether the light `from` could raise the light `to` of an adjacent block with opacity 0.
bool couldRaise(uint from, uint to) {
    return maxLevels(lessLevels(from, 0x01010101u), to) != to;
}
