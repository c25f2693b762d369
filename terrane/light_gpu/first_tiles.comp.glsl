// Lists the light tiles of the first round: tiles of more than one value, and tiles that the sources of a neighbor
// could raise. Open sky, darkness and opaque tiles are left out. Work groups of one y have a chunk.
#include "terrane/light_gpu/light_tiles.glsl"
#include "terrane/light_gpu/work_list.glsl"

layout(local_size_x = 64) in;

void main() {
    TilePlace place = TilePlace(gl_WorkGroupID.y, gl_GlobalInvocationID.x);
    if (place.number >= tilesPerChunk()) return;
    uint tile = indexOf(place);
    lists[2u * tileCount() + tile] = 0u;
    uint summary = tiles[tile];
    if ((summary & kTileIsOpaque) != 0u) return;
    bool mayChange = (summary & kTileIsUniform) == 0u;
    for (uint side = 0u; side < 6u && !mayChange; ++side) {
        uint beside = tileBeside(place, side);
        mayChange = beside != kNoTile && couldRaise(tiles[beside] & 0xFFFFu, summary & 0xFFFFu);
    }
    if (mayChange) addToList(0u, tile);
}
