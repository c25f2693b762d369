// Lists the quads with a bit, command by command, and makes the command draw these (quad_list.h). Each thread handles
// an equal number of consecutive quads, so that their order is kept: of two quads at the same depth the first is
// visible in every frame.
#include "terrane/shared/bindings.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/quad.h"

layout(local_size_x = kQuadCullThreads) in;

layout(location = kArenaLocation) uniform uint arena;
layout(location = kListedBitLocation) uniform uint listedBit;

layout(std140, binding = kCullBinding) uniform CullBlock {
    CullFrame cull;
};
layout(std430, binding = kCommandsBinding) buffer Commands {
    DrawCommand commands[];
};
layout(std430, binding = kDrawRecordsBinding) buffer Records {
    DrawRecord records[];  // of the commands
};
layout(std430, binding = kCountsBinding) buffer Counts {
    DrawCounts counts[];
};
layout(std430, binding = kQuadsBinding) readonly buffer Quads {
    Quad quads[];
};
layout(std430, binding = kListedQuadsBinding) buffer Listed {
    uint listedEnd;
    uint listed[];  // from number 1 on
};

shared uint found[kQuadCullThreads];
shared uint place;

bool isDrawn(uint quad) {
    return (quads[quad].word1 & listedBit) != 0u;
}

void listCommand(uint at, uint into) {
    uint thread = gl_LocalInvocationID.x;
    uint first = records[at].firstQuad, count = commands[at].indexCount / 6u;
    uint each = (count + kQuadCullThreads - 1u) / kQuadCullThreads;
    uint begin = first + min(thread * each, count), end = first + min((thread + 1u) * each, count), own = 0u;
    for (uint quad = begin; quad < end; ++quad) own += isDrawn(quad) ? 1u : 0u;
    found[thread] = own;
    barrier();
    uint before = 0u, all = 0u;
    for (uint k = 0u; k < kQuadCullThreads; ++k) {
        before += k < thread ? found[k] : 0u;
        all += found[k];
    }
    if (thread == 0u) place = atomicAdd(listedEnd, all);
    barrier();
    if (place + all > 1u + uint(listed.length())) return;
    uint to = place - 1u + before;
    for (uint quad = begin; quad < end; ++quad) {
        if (isDrawn(quad)) listed[to++] = quad;
    }
    if (thread == 0u) {
        atomicAdd(counts[into].quads[gl_WorkGroupID.y], all - count);
        commands[at].indexCount = 6u * all;
        records[at].firstQuad = kFirstListedQuad + place;
    }
}

void main() {
    uint number = arena * kDrawLists + gl_WorkGroupID.y, first = cull.firstCommand[number >> 2][number & 3u];
    uint into = 2u * arena + (cull.phase == kCullLate ? 1u : 0u), count = counts[into].commands[gl_WorkGroupID.y];
    for (uint k = gl_WorkGroupID.x; k < count; k += gl_NumWorkGroups.x) listCommand(first + k, into);
}
