// The result: bricks of 16³ in the order of a section's blocks, without those of one value. A work group is a brick.
#include "terrane/light_gpu/cells.glsl"

layout(local_size_x = 256) in;

layout(location = 1) uniform uvec4 part;  // the chunks whose light is wanted: first x and y, number along x and y

layout(std430, binding = kSolverBricksBinding) buffer Bricks {
    uint poolCount;
    uint bricks[];  // by chunk of the part, sixteen each
};
layout(std430, binding = kSolverPoolBinding) writeonly buffer Pool {
    uint pool[];
};

shared uint allLight, anyLight, brick;

uint wordOfBrick(uvec3 corner, uint k) {
    uvec3 word = uvec3(k & 7u, k >> 3 & 15u, k >> 7);
    uint cell = cellIndex(corner + uvec3(word.x >> 2, word.yz >> 3));
    return levels[wordIndex(cell, word & uvec3(3u, 7u, 7u))];
}

void main() {
    uint local = gl_LocalInvocationIndex, chunk = gl_WorkGroupID.x;
    uvec2 place = part.xy + uvec2(chunk % part.z, chunk / part.z);
    uvec3 corner = 2u * uvec3(place, gl_WorkGroupID.y);
    if (local == 0u) {
        allLight = 0xFFFFFFFFu;
        anyLight = 0u;
    }
    barrier();
    uint all = 0xFFFFFFFFu, any = 0u;
    for (uint k = local; k < kBrickWords; k += 256u) {
        uint word = wordOfBrick(corner, k);
        all &= word;
        any |= word;
    }
    atomicAnd(allLight, all);
    atomicOr(anyLight, any);
    barrier();
    bool isUniform = allLight == anyLight && (allLight & 0xFFFFu) == allLight >> 16;
    if (local == 0u) {
        brick = isUniform ? kBrickUniformBit | (allLight & 0xFFFFu) : atomicAdd(poolCount, 1u);
        bricks[chunk * kSectionsPerChunk + gl_WorkGroupID.y] = brick;
    }
    barrier();
    if (isUniform) return;
    for (uint k = local; k < kBrickWords; k += 256u) pool[brick * kBrickWords + k] = wordOfBrick(corner, k);
}
