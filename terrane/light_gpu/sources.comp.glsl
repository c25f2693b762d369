// Sets the first levels: emission, and daylight that comes down each column. Above the solved sections is open sky. A
// work group has a chunk, an invocation the two columns of a word.
#include "terrane/light_gpu/light_tiles.glsl"

layout(local_size_x = 8, local_size_y = kChunkSize) in;

layout(std430, binding = kSolverTilesBinding) writeonly buffer Tiles {
    uint tiles[];  // summaries: see kTileIsUniform
};

// Summaries of the four light tiles of a layer, for two layers in turn.
shared uint allLight[2][4], anyLight[2][4], allOpacity[2][4];

uint daylight[2];  // of the invocation's columns

void resetTile(uint turn, uint k) {
    allLight[turn][k] = 0xFFFFFFFFu;
    anyLight[turn][k] = 0u;
    allOpacity[turn][k] = 15u;
}

uint sourceAt(uint chunk, uvec3 block, uint column, inout uint opacities) {
    uint property = propertyAt(chunk, block), opacity = opacityOf(property);
    opacities &= opacity;
    daylight[column] -= min(daylight[column], opacity);
    return emissionOf(property) | daylight[column] << 12;
}

uint summary(uint turn, uint k) {
    uint all = allLight[turn][k], any = anyLight[turn][k];
    bool isUniform = all == any && (all & 0xFFFFu) == all >> 16;
    return ((any | any >> 16) & 0xFFFFu) | (isUniform ? kTileIsUniform : 0u) |
           (allOpacity[turn][k] == 15u ? kTileIsOpaque : 0u);
}

void main() {
    uint chunk = gl_WorkGroupID.x, local = gl_LocalInvocationIndex;
    uvec2 at = gl_LocalInvocationID.xy;  // x in words
    uint quarter = at.x / 4u + 2u * (at.y / 8u);
    if (local < 8u) resetTile(local >> 2, local & 3u);
    barrier();
    daylight[0] = 15u;
    daylight[1] = 15u;
    for (uint layer = 2u * sectionCount; layer-- > 0u;) {
        uint turn = layer & 1u, all = 0xFFFFFFFFu, any = 0u, opacities = 15u;
        uint tile = tileIndex(chunk, uvec3(at.x / 4u, at.y / 8u, layer));
        for (uint k = kLightTileSize; k-- > 0u;) {
            uvec3 block = uvec3(2u * at.x, at.y, kLightTileSize * layer + k);
            uint word = sourceAt(chunk, block, 0u, opacities);
            word |= sourceAt(chunk, block + uvec3(1u, 0u, 0u), 1u, opacities) << 16;
            levels[wordIndex(tile, uvec3(at.x & 3u, at.y & 7u, k))] = word;
            all &= word;
            any |= word;
        }
        atomicAnd(allLight[turn][quarter], all);
        atomicOr(anyLight[turn][quarter], any);
        atomicAnd(allOpacity[turn][quarter], opacities);
        barrier();
        // The results of the other layers are used until the next barrier, so these can be read and reset.
        if (local < 4u) {
            tiles[tileIndex(chunk, uvec3(local & 1u, local >> 1, layer))] = summary(turn, local);
            resetTile(turn, local);
        }
    }
}
