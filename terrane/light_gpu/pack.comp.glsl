// Packs the result: bricks of 16³ in the order of a section's blocks; bricks of one value have an entry only. A work
// group packs one brick of a requested chunk; these come first. While light tiles are left that could change, only
// their number is written.
#include "terrane/light_gpu/light_tiles.glsl"

layout(local_size_x = 256) in;

layout(std430, binding = kSolverResultBinding) writeonly buffer Result {
    uint result[];  // layout: resultEntry(), resultWords()
};

shared uint allLight, anyLight, brick;

uint wordOfBrick(uint k) {
    uvec3 word = uvec3(k & 7u, k >> 3 & 15u, k >> 7);
    uvec3 place = uvec3(word.x >> 2, word.y >> 3, 2u * gl_WorkGroupID.y + (word.z >> 3));
    return levels[wordIndex(tileIndex(gl_WorkGroupID.x, place), word & uvec3(3u, 7u, 7u))];
}

void packBrick(uint local) {
    if (local == 0u) {
        allLight = 0xFFFFFFFFu;
        anyLight = 0u;
    }
    barrier();
    uint all = 0xFFFFFFFFu, any = 0u;
    for (uint k = local; k < kBrickWords; k += 256u) {
        uint word = wordOfBrick(k);
        all &= word;
        any |= word;
    }
    atomicAnd(allLight, all);
    atomicOr(anyLight, any);
    barrier();
    bool isUniform = allLight == anyLight && (allLight & 0xFFFFu) == allLight >> 16;
    if (local == 0u) {
        brick = isUniform ? kBrickUniformBit | (allLight & 0xFFFFu) : atomicAdd(brickCount, 1u);
        result[resultEntry(gl_WorkGroupID.x, gl_WorkGroupID.y, sectionCount)] = brick;
    }
    barrier();
    if (isUniform) return;
    uint first = resultWords(gl_NumWorkGroups.x * sectionCount, brick);
    for (uint k = local; k < kBrickWords; k += 256u) result[first + k] = wordOfBrick(k);
}

void main() {
    uint local = gl_LocalInvocationIndex, tilesLeft = rounds[kSolverRounds].groupsX;
    if (local == 0u && gl_WorkGroupID.x == 0u && gl_WorkGroupID.y == 0u) result[0] = tilesLeft;
    if (tilesLeft == 0u) packBrick(local);
}
