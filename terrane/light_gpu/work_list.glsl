// Work lists of light tiles that may change in a round, and the neighbors of light tiles. Two lists take turns; the
// dispatch of a round has a work group for each entry.
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

// A light tile by its chunk and its number in the chunk.
struct TilePlace {
    uint chunk;
    uint number;
};

uint indexOf(TilePlace tile) {
    return tile.chunk * tilesPerChunk() + tile.number;
}

// Corner of a light tile in its chunk, in blocks.
uvec3 tileCorner(TilePlace tile) {
    return kLightTileSize * uvec3(tile.number & 1u, tile.number >> 1 & 1u, tile.number >> 2);
}

// Index of the light tile beyond a side: −x, +x, −y, +y, −z, +z; kNoTile if unknown.
uint tileBeside(TilePlace tile, uint side) {
    bool isUp = (side & 1u) != 0u;
    if (side >= 4u) {
        if (isUp ? tile.number + 4u >= tilesPerChunk() : tile.number < 4u) return kNoTile;
        return isUp ? indexOf(tile) + 4u : indexOf(tile) - 4u;
    }
    uint axis = side >> 1, other = tile.number ^ 1u << axis;
    if (isUp == ((tile.number >> axis & 1u) == 0u)) return indexOf(TilePlace(tile.chunk, other));
    uint chunk = neighbors[tile.chunk][side];
    return chunk == kNoChunk ? kNoTile : indexOf(TilePlace(chunk, other));
}

TilePlace tileOfList(uint list, uint entry) {
    uint tile = lists[(list & 1u) * tileCount() + entry];
    return TilePlace(tile / tilesPerChunk(), tile % tilesPerChunk());
}

void addToList(uint list, uint tile) {
    lists[(list & 1u) * tileCount() + atomicAdd(rounds[list].groupsX, 1u)] = tile;
}

// Whether the light `from` could raise the light `to` of an adjacent block with opacity 0.
bool couldRaise(uint from, uint to) {
    return maxLevels(lessLevels(from, 0x01010101u), to) != to;
}
