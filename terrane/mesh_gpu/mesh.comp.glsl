// Meshes a unit, one a work group: a section, or the part of it in one mesh section. Invocations find the visible
// faces, one row of blocks each; then 96 planes of them are merged with bit operations.
#include "terrane/mesh_gpu/merge.glsl"
#include "terrane/mesh_gpu/liquids.glsl"

layout(local_size_x = 256) in;

// Finds the visible faces of the invocation's row and writes them to the planes; returns the row, empty if it belongs
// to another mesh section.
Row shareRow(MeshUnit unit, uint local) {
    Row row = readRow(unit, local);
    shareOpaque(unit, row, local);
    barrier();
    uint z = local / kSectionSize, seen[6];
    findSeen(unit, row, local, seen);
    leaveOutFlowing(row, seen);
    surface[local] = seen[5] & row.liquid;
    bool isInMeshSection = z >= (unit.layers & 0xFFFFu) && z < unit.layers >> 16;
    if (!isInMeshSection) return Row(0u, 0u, 0u, 0u, 0u, 0u);
    shareSeen(seen, local);
#if !WRITES_QUADS
    if ((seen[0] | seen[1] | seen[2] | seen[3] | seen[4] | seen[5]) != 0u) coverLayer(z);
#endif
    return row;
}

void begin(MeshUnit unit, uint unitIndex, uint local) {
    for (uint k = local; k < kPaddedSize * kPaddedSize; k += kBlocksPerLayer) opaqueRows[k] = 0u;
    for (uint k = local; k < 6u * kBlocksPerLayer; k += kBlocksPerLayer) faces[k] = 0u;
#if WRITES_QUADS
    if (local < kRangesPerMeshSection) {
        uint count = unitCounts[kMeshUnitWords * unitIndex + local];
        if (count > 0u) counters[local] = atomicAdd(places[kRangesPerMeshSection * unit.meshSection + local], count);
    }
#else
    if (local < kRangesPerMeshSection) counters[local] = 0u;
    if (local == 0u) {
        lowest = kSectionSize;
        highest = 0u;
    }
#endif
    barrier();
}

#if !WRITES_QUADS
void reportCounts(MeshUnit unit, uint unitIndex, uint local) {
    barrier();
    if (local < kRangesPerMeshSection) {
        unitCounts[kMeshUnitWords * unitIndex + local] = counters[local];
        if (counters[local] > 0u) atomicAdd(meshSections[unit.meshSection].quads[local], counters[local]);
    }
    if (local != 0u) return;
    unitCounts[kMeshUnitWords * unitIndex + kRangesPerMeshSection] = highest;
    if (highest == 0u) return;
    atomicMin(meshSections[unit.meshSection].minZ, unit.baseZ + lowest);
    atomicMax(meshSections[unit.meshSection].maxZ, unit.baseZ + highest);
}
#endif

void main() {
    uint local = gl_LocalInvocationIndex, unitIndex = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
    if (unitIndex >= uint(units.length())) return;  // the last row has some more work groups
    MeshUnit unit = units[unitIndex];
#if WRITES_QUADS
    if (unitCounts[kMeshUnitWords * unitIndex + kRangesPerMeshSection] == 0u) return;  // no visible faces
    if (places[kRangesPerMeshSection * unit.meshSection] == kNoPlace) return;
#endif
    begin(unit, unitIndex, local);
    Row row = shareRow(unit, local);
    barrier();
    for (uint side = 0u; side < 6u; ++side) compareKinds(side, local);
    barrier();
    addPlanes(unit, row.planes, local);
    addFlow(unit, row, local);
    if (method != kMergeGreedy) {
        mergeInPasses(unit, local);
    } else if (local < 96u) {
        mergeGreedily(unit, local / kSectionSize, local % kSectionSize);
    }
#if !WRITES_QUADS
    reportCounts(unit, unitIndex, local);
#endif
}
