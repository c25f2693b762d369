// Cells that may change in a round, and which cells lie beside each other. Two lists take turns; a round's dispatch has a
// work group for each entry.
#include "terrane/light_gpu/solver_state.glsl"

layout(std430, binding = kSolverCellsBinding) readonly buffer Cells {
    uint cells[];  // what kCellIs… says
};
layout(std430, binding = kSolverListsBinding) buffer Lists {
    uint lists[];  // two lists of cells, then for each cell the last round that it was put down for
};
layout(std430, binding = kSolverNeighboursBinding) readonly buffer Neighbours {
    uvec4 neighbours[];  // by chunk: those at −x, +x, −y, +y, or kNoChunk
};

const uint kNoCell = 0xFFFFFFFFu;

// The cell beyond a side: −x, +x, −y, +y, −z, +z; kNoCell where nothing is known.
uint cellBeside(uint cell, uint side) {
    bool isUp = (side & 1u) != 0u;
    if (side >= 4u) {
        uint z = cell >> 2 & (kCellsHigh - 1u);
        if (z == (isUp ? kCellsHigh - 1u : 0u)) return kNoCell;
        return isUp ? cell + 4u : cell - 4u;
    }
    uint axis = side >> 1, other = cell ^ 1u << axis;
    if (isUp == ((cell >> axis & 1u) == 0u)) return other;  // of the same chunk
    uint chunk = neighbours[cell / kCellsPerChunk][side];
    return chunk == kNoChunk ? kNoCell : chunk * kCellsPerChunk + other % kCellsPerChunk;
}

uint cellOfList(uint list, uint entry) {
    return lists[(list & 1u) * cellCount() + entry];
}

void addToList(uint list, uint cell) {
    lists[(list & 1u) * cellCount() + atomicAdd(rounds[list].groupsX, 1u)] = cell;
}

// Whether light of `from` could raise that of `to`, a block of the least opacity beside it.
bool couldRaise(uint from, uint to) {
    return maxLevels(lessLevels(from, 0x01010101u), to) != to;
}
