// Writes the draw commands of each list, a work group a list, in the order of the regions. Each thread takes as many
// neighbouring regions as there are for it: counts their commands, learns from the sum over the threads before where its
// own begin, and writes them.
#include "terrane/shared/bindings.h"
#include "terrane/shared/region.h"

const uint kThreads = 512u;
layout(local_size_x = kThreads) in;

layout(std140, binding = kCullBinding) uniform CullBlock {
    CullFrame cull;
};
layout(std430, binding = kRegionsBinding) readonly buffer Regions {
    RegionRecord regions[];
};
layout(std430, binding = kRegionOrderBinding) readonly buffer Order {
    uint order[];
};
layout(std430, binding = kVisibleBinding) readonly buffer Visible {
    uint visible[];
};
layout(std430, binding = kCommandsBinding) writeonly buffer Commands {
    DrawCommand commands[];
};
layout(std430, binding = kCountsBinding) writeonly buffer Counts {
    DrawCounts counts[2];  // of the two runs
};

shared uint sums[kThreads];
shared uint quadSum, regionSum;

uint commandsFor(uint quads) {
    return (quads + kMaxQuadsPerCommand - 1u) / kMaxQuadsPerCommand;
}

uint writeCommands(uvec2 quads, uint slot, uint at) {
    while (quads.y > 0u) {
        uint part = min(quads.y, kMaxQuadsPerCommand);
        commands[at++] = DrawCommand(6u * part, 1u, 0u, int(4u * quads.x), slot);
        quads += uvec2(part, -part);
    }
    return at;
}

// Commands for the groups of a region, neighbouring ones together; written from `at` on where `isWriting`. Returns the
// place behind them. Adds the quads to `quads`.
uint visit(uint slot, uint context, uint groups, uint at, bool isWriting, inout uint quads) {
    uint isTwoSided = context & 1u;
    uvec2 pending = uvec2(0u);
    for (uint k = 0u; k < kFaceGroups; ++k) {
        if (isTwoSided == 1u && k > 0u) break;
        uint group = isTwoSided == 1u ? kFaceGroups - 1u : k;
        uvec2 range = regions[slot].ranges[firstRange(context) + k];
        if ((groups >> group & 1u) == 0u || range.y == 0u) continue;
        quads += range.y;
        if (pending.x + pending.y == range.x && pending.y > 0u) {
            pending.y += range.y;
            continue;
        }
        at = isWriting ? writeCommands(pending, slot, at) : at + commandsFor(pending.y);
        pending = range;
    }
    return isWriting ? writeCommands(pending, slot, at) : at + commandsFor(pending.y);
}

// Sums of all threads up to this one, it included.
uint scan(uint thread, uint value) {
    sums[thread] = value;
    barrier();
    for (uint step = 1u; step < kThreads; step *= 2u) {
        uint before = thread >= step ? sums[thread - step] : 0u;
        barrier();
        sums[thread] += before;
        barrier();
    }
    return sums[thread];
}

void main() {
    uint thread = gl_LocalInvocationID.x, list = gl_WorkGroupID.x;
    bool isShadow = list >= kCameraLists;
    uint context = isShadow ? list - kCameraLists : list;
    uint shift = isShadow ? kShadowGroupBits : context >= 4u ? kBlendedGroupBits : kCameraGroupBits;
    uint all = cull.regionCount, each = (all + kThreads - 1u) / kThreads;
    uint begin = min(thread * each, all), end = min(begin + each, all);
    if (thread == 0u) quadSum = regionSum = 0u;
    barrier();

    uint quads = 0u, own = 0u, regionCount = 0u;
    for (uint k = begin; k < end; ++k) {
        uint groups = visible[k] >> shift & 127u;
        if (groups == 0u) continue;
        ++regionCount;
        own = visit(order[k], context, groups, own, false, quads);
    }
    atomicAdd(quadSum, quads);
    atomicAdd(regionSum, regionCount);
    uint last = scan(thread, own);
    uint at = cull.firstCommand[list >> 2][list & 3u] + last - own;
    uint ignored = 0u;
    for (uint k = begin; k < end; ++k) {
        uint groups = visible[k] >> shift & 127u;
        if (groups != 0u) at = visit(order[k], context, groups, at, true, ignored);
    }
    if (thread == kThreads - 1u) {
        uint run = cull.run == kCullSeenNow ? 1u : 0u;
        counts[run].commands[list] = last;
        counts[run].quads[list] = quadSum;
        if (list == 0u) counts[run].regions = regionSum;
    }
}
