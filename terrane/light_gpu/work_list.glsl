// Cells that may change in a round. Two lists take turns; a round's dispatch has a work group for each entry.
layout(std430, binding = kSolverCellsBinding) readonly buffer Cells {
    uint cells[];  // what kCellIs… says
};
layout(std430, binding = kSolverListsBinding) buffer Lists {
    uint lists[];  // two lists of cells, then for each cell the last round that it was put down for
};
layout(std430, binding = kSolverRoundsBinding) buffer Rounds {
    SolverRound rounds[];
};

uint cellCount() {
    return kCellsPerChunk * areaChunks.x * areaChunks.y;
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

const ivec3 kSides[6] = ivec3[](ivec3(-1, 0, 0), ivec3(1, 0, 0), ivec3(0, -1, 0), ivec3(0, 1, 0), ivec3(0, 0, -1),
                                ivec3(0, 0, 1));
