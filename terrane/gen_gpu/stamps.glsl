// The shapes that stand around a chunk: gen/noise/stamp_tile.cpp for one voxel at a time, with the same rule. A work group first
// gathers the feet of its 3×3 chunks; each column then looks only at those.
#include "terrane/gen_gpu/tile.glsl"

// Number of shapes; kShapePaletteWords of block | rank << 16; for each shape its lowest voxel + 32, its size (8 bits an
// axis), its first cell as a byte of this buffer, unused; cells of 8 bits by z, y, x: a number in the palette.
layout(std430, binding = kShapesBinding) readonly buffer Shapes {
    uint shapeWords[];
};

const uint kFeetWindow = 3u * kChunkSize;
// Shapes are -8 to 48 blocks high: those of other feet do not reach the layers of this work group.
const int kLowestFoot = -48, kHighestFoot = LAYERS_PER_GROUP + 8;  // from the group's first layer

// x | y << 6 | shape << 12 | call << 22 | height from kLowestFoot << 23
shared uint feet[kFeetWindow * kFeetWindow * kMaxStampsInPass];
shared uint footCount;
int stampLow, stampHigh;  // layers of this column that shapes may reach

// Feet whose shapes may reach this column. If there are more than kMaxNearFeet, all feet are searched: a software
// driver may end loops after 65,536 rounds in total, which only more than a thousand feet could exceed.
const uint kMaxNearFeet = 24u;
uint nearFeet[kMaxNearFeet];
uint nearCount;

struct Foot {
    ivec3 position;  // from the chunk's corner; z absolute
    uint shape, call;
};

Foot footOf(uint word) {
    ivec2 position = ivec2(word & 63u, word >> 6 & 63u) - kMaxReadOffset;
    return Foot(ivec3(position, int(word >> 23) + kLowestFoot + firstLayer()), word >> 12 & 1023u, word >> 22 & 1u);
}

uint shapeWord(uint shape, uint number) {
    return shapeWords[1u + kShapePaletteWords + 4u * shape + number];
}

ivec3 shapeLow(uint shape) {
    uint word = shapeWord(shape, 0u);
    return ivec3(word & 255u, word >> 8 & 255u, word >> 16) - 32;
}

ivec3 shapeSize(uint shape) {
    uint word = shapeWord(shape, 1u);
    return ivec3(word & 255u, word >> 8 & 255u, word >> 16);
}

void beginStamps() {
    if (gl_LocalInvocationIndex == 0u) footCount = 0u;
    barrier();
}

void findFeet(uint call, uint shapeField, uint baseField) {
    for (uint neighbor = 0u; neighbor < 9u; ++neighbor) {
        uint from = jobs[gl_WorkGroupID.x].fieldSlots[neighbor >> 2][neighbor & 3u] * FIELD_COUNT;
        uint shape = fields[(from + shapeField) * kBlocksPerLayer + column];
        if (shape >= shapeWords[0]) continue;
        int base = int(fields[(from + baseField) * kBlocksPerLayer + column]);
        if (base < firstLayer() + kLowestFoot || base > firstLayer() + kHighestFoot) continue;
        uvec2 place = gl_LocalInvocationID.xy + kChunkSize * uvec2(neighbor % 3u, neighbor / 3u);
        feet[atomicAdd(footCount, 1u)] =
            place.x | place.y << 6 | shape << 12 | call << 22 | uint(base - firstLayer() - kLowestFoot) << 23;
    }
}

// The column of this invocation, from the foot's.
ivec2 columnFrom(Foot foot) {
    return ivec2(gl_LocalInvocationID.xy) - foot.position.xy;
}

void endStamps() {
    barrier();
    stampLow = TOP;
    stampHigh = BOTTOM - 1;
    nearCount = 0u;
    for (uint k = 0u; k < footCount; ++k) {
        Foot foot = footOf(feet[k]);
        ivec3 low = shapeLow(foot.shape), size = shapeSize(foot.shape);
        ivec2 at = columnFrom(foot) - low.xy;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size.xy))) continue;
        stampLow = min(stampLow, foot.position.z + low.z);
        stampHigh = max(stampHigh, foot.position.z + low.z + size.z - 1);
        if (nearCount < kMaxNearFeet) nearFeet[nearCount] = feet[k];
        ++nearCount;
    }
}

// The palette's word of a shape's cell; 0 outside.
uint shapeCell(uint shape, ivec3 offset) {
    ivec3 size = shapeSize(shape), at = offset - shapeLow(shape);
    if (any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, size))) return 0u;
    uint cell = shapeWord(shape, 2u) + uint((at.z * size.y + at.y) * size.x + at.x);
    return shapeWords[1u + (shapeWords[cell >> 2] >> 8u * (cell & 3u) & 255u)];
}

// Takes the foot with the highest rank, then the smallest y, then the smallest x.
int stampAt(uint call, int z) {
    if (z < stampLow || z > stampHigh) return 0;
    uint best = 0u, block = 0u;
    bool isListed = nearCount <= kMaxNearFeet;
    uint count = isListed ? nearCount : footCount;
    for (uint k = 0u; k < count; ++k) {
        Foot foot = footOf(isListed ? nearFeet[min(k, kMaxNearFeet - 1u)] : feet[k]);
        if (foot.call != call) continue;
        uint cell = shapeCell(foot.shape, ivec3(columnFrom(foot), z - foot.position.z));
        uint order = (cell >> 16 << 12 | (4095u - uint(foot.position.y + kMaxReadOffset) * 64u -
                                          uint(foot.position.x + kMaxReadOffset))) + 1u;
        if (cell == 0u || order <= best) continue;
        best = order;
        block = cell & 0xFFFFu;
    }
    return int(block);
}
