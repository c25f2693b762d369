// Writes the draw commands of each list and arena, a work group each, in the order of the mesh sections. Each thread
// handles an equal number of consecutive mesh sections: it counts their commands, gets its first place from a prefix
// sum over the threads, and writes them.
#include "terrane/shared/bindings.h"
#include "terrane/shared/mesh_section.h"

const uint kThreads = 512u;
layout(local_size_x = kThreads) in;

layout(std140, binding = kCullBinding) uniform CullBlock {
    CullFrame cull;
};
layout(std430, binding = kMeshSectionsBinding) readonly buffer MeshSections {
    MeshSectionRecord meshSections[];
};
layout(std430, binding = kMeshSectionOrderBinding) readonly buffer Order {
    uint order[];
};
layout(std430, binding = kVisibleBinding) readonly buffer Visible {
    uint visible[];
};
layout(std430, binding = kCommandsBinding) writeonly buffer Commands {
    DrawCommand commands[];
};
layout(std430, binding = kDrawRecordsBinding) writeonly buffer Records {
    DrawRecord records[];  // of the commands
};
layout(std430, binding = kCountsBinding) writeonly buffer Counts {
    DrawCounts counts[];  // two for each arena: of the early and the late pass
};

shared uint sums[kThreads];
shared uint quadSum, meshSectionSum;

uint firstCommandOf(uint number) {
    return number < 4u * kFirstCommandVectors ? cull.firstCommand[number >> 2][number & 3u] : cull.commandsEnd;
}

uint commandsFor(uint quads) {
    return (quads + kMaxQuadsPerCommand - 1u) / kMaxQuadsPerCommand;
}

// Face directions of the mesh section at a place in the order, if it is in the work group's arena.
uint directionsOf(uint place, uint shift) {
    uint word = visible[place];
    return word >> kArenaBits == gl_WorkGroupID.y ? word >> shift & 127u : 0u;
}

// The CPU reserves room for all commands; without it, some are left out.
uint writeCommands(uvec2 quads, uint slot, uint at, uint end) {
    quads.x -= gl_WorkGroupID.y * cull.arenaQuads;
    while (quads.y > 0u) {
        uint part = min(quads.y, kMaxQuadsPerCommand);
        if (at < end) {
            commands[at] = DrawCommand(6u * part, 1u, 0u, 0, at);
            records[at] = DrawRecord(meshSections[slot].chunk, meshSections[slot].place, quads.x);
        }
        ++at;
        quads += uvec2(part, -part);
    }
    return at;
}

// Commands for the face directions of a mesh section, adjacent ranges together; written from `at` on, up to `end`, if
// `isWriting`. Returns the place after them. Adds the quads to `quads`.
uint visit(uint slot, uint bucket, uint directions, uint at, uint end, bool isWriting, inout uint quads) {
    uint isTwoSided = bucket & 1u;
    uvec2 pending = uvec2(0u);
    for (uint k = 0u; k < kFaceDirections; ++k) {
        if (isTwoSided == 1u && k > 0u) break;
        uint direction = isTwoSided == 1u ? kFaceDirections - 1u : k;
        uvec2 range = meshSections[slot].ranges[firstRange(bucket) + k];
        if ((directions >> direction & 1u) == 0u || range.y == 0u) continue;
        quads += range.y;
        if (pending.x + pending.y == range.x && pending.y > 0u) {
            pending.y += range.y;
            continue;
        }
        at = isWriting ? writeCommands(pending, slot, at, end) : at + commandsFor(pending.y);
        pending = range;
    }
    return isWriting ? writeCommands(pending, slot, at, end) : at + commandsFor(pending.y);
}

// Inclusive prefix sum over the threads.
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
    uint thread = gl_LocalInvocationID.x, list = gl_WorkGroupID.x, arena = gl_WorkGroupID.y;
    uint shift = list >= 4u ? kBlendedDirectionBits : kOpaqueDirectionBits;
    uint all = cull.meshSectionCount, each = (all + kThreads - 1u) / kThreads;
    uint begin = min(thread * each, all), end = min(begin + each, all);
    if (thread == 0u) quadSum = meshSectionSum = 0u;
    barrier();

    uint quads = 0u, own = 0u, meshSectionCount = 0u;
    for (uint k = begin; k < end; ++k) {
        uint directions = directionsOf(k, shift);
        if (directions == 0u) continue;
        ++meshSectionCount;
        own = visit(order[k], list, directions, own, 0u, false, quads);
    }
    atomicAdd(quadSum, quads);
    atomicAdd(meshSectionSum, meshSectionCount);
    uint last = scan(thread, own);
    uint number = arena * kDrawLists + list;
    uint first = firstCommandOf(number), endOfList = firstCommandOf(number + 1u), at = first + last - own;
    uint ignored = 0u;
    for (uint k = begin; k < end; ++k) {
        uint directions = directionsOf(k, shift);
        if (directions != 0u) at = visit(order[k], list, directions, at, endOfList, true, ignored);
    }
    if (thread == kThreads - 1u) {
        uint into = 2u * arena + (cull.phase == kCullLate ? 1u : 0u);
        counts[into].commands[list] = min(last, endOfList - first);
        counts[into].quads[list] = quadSum;
        if (list == 0u) counts[into].meshSections = meshSectionSum;
    }
}
