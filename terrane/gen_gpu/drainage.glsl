// Distance to rivers and lakes for one column, with the steps of gen/drainage_kernels-inl.h in the same order. For 2D passes
// that read drainage maps.
#include "terrane/shared/det_math.h"
#include "terrane/shared/drainage.h"

layout(std430, binding = kDrainageListsBinding) readonly buffer DrainageLists {
    DrainageList drainageLists[];
};
layout(std430, binding = kDrainageDataBinding) readonly buffer DrainageData {
    vec4 drainageData[];
};

struct Drainage {
    float distance, halfWidth, level, flow, lakeDistance, lakeLevel, fall;
};

const float kNoPower = 3.402823466e38;

// The nearest point of a segment: 0…1 from its upper end, and blocks² to it.
void placeOn(vec4 line, float inverseLength2, float x, float y, out float place, out float distance2) {
    precise float fromX = x - line.x, fromY = y - line.y;
    precise float along = (fromX * line.z + fromY * line.w) * inverseLength2;
    along = along < 0.0 ? 0.0 : along;
    along = 1.0 < along ? 1.0 : along;
    precise float offX = fromX - along * line.z, offY = fromY - along * line.w;
    precise float sum = offX * offX + offY * offY;
    place = along;
    distance2 = sum;
}

Drainage drainage(uint map, uint mapCount, float reach) {
    DrainageList list = drainageLists[gl_WorkGroupID.x * mapCount + map];
    int step = jobs[gl_WorkGroupID.x].origin.w;
    precise float x = float(int(gl_LocalInvocationID.x) * step), y = float(int(gl_LocalInvocationID.y) * step);
    precise float reach2 = reach * reach;
    Drainage result = Drainage(kNoRiver, 0.0, 0.0, 0.0, kNoRiver, 0.0, 0.0);
    float best = kNoPower, bestDistance2 = 0.0;
    uint at = list.first;
    for (uint k = 0u; k < list.segmentCount; ++k) {
        vec4 line = drainageData[at], course = drainageData[at + 1u], flow = drainageData[at + 2u];
        at += kVectorsPerSegment;
        float along, distance2;
        placeOn(line, course.x, x, y, along, distance2);
        precise float halfWidth = course.y + along * course.z;
        precise float power = distance2 - halfWidth * halfWidth;
        if (!(distance2 < reach2 && power < best && 0.0 < halfWidth)) continue;
        best = power;
        bestDistance2 = distance2;
        precise float level = course.w + along * flow.x, nodes = flow.y + along * flow.z;
        result.halfWidth = halfWidth;
        result.level = level;
        result.flow = nodes;
        result.fall = flow.w;
    }
    if (best < kNoPower) result.distance = detSqrt(bestDistance2);
    float bestLake = kNoPower;
    for (uint k = 0u; k < list.lakeCount; ++k) {
        vec4 lake = drainageData[at + k];
        precise float fromX = x - lake.x, fromY = y - lake.y;
        precise float distance2 = fromX * fromX + fromY * fromY;
        precise float power = distance2 - lake.z * lake.z;
        precise float far = lake.z + reach;
        precise float far2 = far * far;
        if (!(distance2 < far2 && power < bestLake)) continue;
        bestLake = power;
        precise float shore = detSqrt(distance2) - lake.z;
        result.lakeDistance = shore;
        result.lakeLevel = lake.w;
    }
    return result;
}

struct Valleys {
    float distance, level, flow;
};

// Blocks from the tile's first column.
Valleys valleysAt(DrainageList list, float reach, float x, float y) {
    precise float reach2 = reach * reach;
    precise float reachPlusOne = reach2 + 1.0;
    float reachWeight = detDivide(1.0, reachPlusOne);
    precise float weights = 0.0, distances = 0.0, levels = 0.0, flows = 0.0;
    uint at = list.first;
    for (uint k = 0u; k < list.segmentCount; ++k) {
        vec4 line = drainageData[at], course = drainageData[at + 1u], flow = drainageData[at + 2u];
        at += kVectorsPerSegment;
        float along, distance2;
        placeOn(line, course.x, x, y, along, distance2);
        if (!(distance2 < reach2)) continue;
        precise float plusOne = distance2 + 1.0;
        float inverse = detInverseSqrt(plusOne);
        precise float part = inverse * inverse - reachWeight;
        precise float weight = part * part;
        precise float distance = plusOne * inverse;
        precise float level = course.w + along * flow.x, nodes = flow.y + along * flow.z;
        distances = distances + weight * distance;
        levels = levels + weight * level;
        flows = flows + weight * nodes;
        weights = weights + weight;
    }
    if (!(kLeastStreamWeight < weights)) return Valleys(kNoRiver, 0.0, 0.0);
    return Valleys(detDivide(distances, weights), detDivide(levels, weights), detDivide(flows, weights));
}

Valleys blendValleys(Valleys a, Valleys b, float part) {
    precise float distance = a.distance + (b.distance - a.distance) * part;
    precise float level = a.level + (b.level - a.level) * part;
    precise float flow = a.flow + (b.flow - a.flow) * part;
    return Valleys(distance, level, flow);
}

Valleys valleys(uint map, uint mapCount, float reach) {
    DrainageList list = drainageLists[gl_WorkGroupID.x * mapCount + map];
    int step = jobs[gl_WorkGroupID.x].origin.w;
    int stride = max(kValleyBlocks / step, 1);  // columns from place to place
    ivec2 column = ivec2(gl_LocalInvocationID.xy), first = column / stride * stride;
    bool isBetweenX = column.x != first.x, isBetweenY = column.y != first.y;
    vec2 part = vec2((column - first) * step) * (1.0 / float(kValleyBlocks));
    Valleys found[2];
    for (int n = 0; n < (isBetweenY ? 2 : 1); ++n) {
        float y = float((first.y + n * stride) * step);
        found[n] = valleysAt(list, reach, float(first.x * step), y);
        if (isBetweenX)
            found[n] = blendValleys(found[n], valleysAt(list, reach, float((first.x + stride) * step), y), part.x);
    }
    if (isBetweenY) return blendValleys(found[0], found[1], part.y);
    return found[0];
}
