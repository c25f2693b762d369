// Meshes a unit: a section, or as much of it as lies in one region. A work group is a unit. Rows of blocks, an invocation
// each, find the faces that are seen; 96 planes, an invocation each, merge them. Both read and change bits only: which
// faces may become one quad with their neighbour is found out before, for all planes at once.
#include "terrane/mesh_gpu/quads.glsl"

layout(local_size_x = 256) in;

layout(location = 0) uniform uint merges;  // 0: one quad a face

// By side, then row·16 + plane: faces of the kind of the one before them in their row, << 16: in the row before.
shared uint sameKind[6 * 256];

// Faces of one kind have the same block type, and of a liquid lie both under its surface or in it.
uint kindOf(uint side, uvec3 cell) {
    uint isSurface = side < 4u ? surface[cell.y + 16u * cell.z] >> cell.x & 1u : 0u;
    return idAt(cell) | isSurface << 16;
}

// local: row·16 + plane
void compareKinds(uint side, uint local) {
    uint seen = faces[256u * side + local], before = local < 16u ? 0u : faces[256u * side + local - 16u];
    uint same = 0u, kindBefore = 0u;
    for (uint left = seen; left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left)), kind = kindOf(side, cellOf(side, local & 15u, local >> 4, bit));
        bool doesMerge = (types[typeOf(kind & 0xFFFFu)].flags >> (kMeshMergesShift + side) & merges) != 0u;
        if (doesMerge && (seen << 1 >> bit & 1u) != 0u && kind == kindBefore) same |= 1u << bit;
        if (doesMerge && (before >> bit & 1u) != 0u &&
            kind == kindOf(side, cellOf(side, local & 15u, (local >> 4) - 1u, bit))) {
            same |= 0x10000u << bit;
        }
        kindBefore = kind;
    }
    sameKind[256u * side + local] = same;
}

// How many rows have a run of faces, all of the kind of its row: `first` is its place. A row in which that kind goes on
// beside both ends of the run is left out, since it would be cut in three. Rows behind the first lose the run.
uint takeRows(uint first, uint row, uint run) {
    uint rows = 1u, lowest = run & (0u - run), after = run + lowest;
    for (uint at = first + 16u; row + rows < 16u; at += 16u, ++rows) {
        uint seen = faces[at], same = sameKind[at];
        if ((seen & run) != run || (same >> 16 & run) != run) break;
        bool goesOnBefore = (same & lowest) != 0u && (seen & lowest >> 1) != 0u;
        if (goesOnBefore && (same & after) != 0u && (seen & after) != 0u) break;
        faces[at] = seen ^ run;
    }
    return rows;
}

void mergePlane(MeshUnit unit, uint side, uint plane) {
    for (uint row = 0u; row < 16u; ++row) {
        uint at = 256u * side + 16u * row + plane, left = faces[at], same = sameKind[at] & 0xFFFFu;
        while (left != 0u) {
            uint lowest = left & (0u - left), bit = uint(findLSB(left));
            // Adding the lowest face to those that go on from one to the next carries through the run.
            uint goesOn = left & same & ~lowest | lowest;
            uint run = goesOn & ~(goesOn + lowest);
            left ^= run;
            uint rows = takeRows(at, row, run);
            addFaces(unit, side, cellOf(side, plane, row, bit), uvec2(bitCount(run), rows));
        }
    }
}

// Finds what is seen of the invocation's row, and gives it to the planes; returns planes inside cells.
uint shareRow(MeshUnit unit, uint local) {
    Row row = readRow(unit, local);
    shareOpaque(unit, row, local);
    barrier();
    uint z = local >> 4, seen[6];
    findSeen(unit, row, local, seen);
    surface[local] = seen[5] & row.liquid;
    bool isInRegion = z >= (unit.layers & 0xFFFFu) && z < unit.layers >> 16;
    if (!isInRegion) return 0u;
    shareSeen(seen, local);
#if !WRITES_QUADS
    if ((row.planes | seen[0] | seen[1] | seen[2] | seen[3] | seen[4] | seen[5]) != 0u) {
        atomicMin(lowest, z);
        atomicMax(highest, z + 1u);
    }
#endif
    return row.planes;
}

void begin(MeshUnit unit, uint unitIndex, uint local) {
    for (uint k = local; k < 324u; k += 256u) opaqueRows[k] = 0u;
    for (uint k = local; k < 6u * 256u; k += 256u) faces[k] = 0u;
#if WRITES_QUADS
    if (local < kRangesOfRegion) {
        uint count = unitCounts[kMeshUnitWords * unitIndex + local];
        if (count > 0u) counters[local] = atomicAdd(places[kRangesOfRegion * unit.region + local], count);
    }
#else
    if (local < kRangesOfRegion) counters[local] = 0u;
    if (local == 0u) {
        lowest = 16u;
        highest = 0u;
    }
#endif
    barrier();
}

#if !WRITES_QUADS
void reportCounts(MeshUnit unit, uint unitIndex, uint local) {
    barrier();
    if (local < kRangesOfRegion) {
        unitCounts[kMeshUnitWords * unitIndex + local] = counters[local];
        if (counters[local] > 0u) atomicAdd(regions[unit.region].quads[local], counters[local]);
    }
    if (local != 0u) return;
    unitCounts[kMeshUnitWords * unitIndex + kRangesOfRegion] = highest;
    if (highest == 0u) return;
    atomicMin(regions[unit.region].minZ, unit.baseZ + lowest);
    atomicMax(regions[unit.region].maxZ, unit.baseZ + highest);
}
#endif

void main() {
    uint local = gl_LocalInvocationIndex, unitIndex = gl_WorkGroupID.x;
    MeshUnit unit = units[unitIndex];
#if WRITES_QUADS
    if (unitCounts[kMeshUnitWords * unitIndex + kRangesOfRegion] == 0u) return;  // nothing to be seen
#endif
    begin(unit, unitIndex, local);
    uint planes = shareRow(unit, local);
    barrier();
    for (uint side = 0u; side < 6u; ++side) compareKinds(side, local);
    barrier();
    addPlanes(unit, planes, local);
    if (local < 96u) mergePlane(unit, local >> 4, local & 15u);
#if !WRITES_QUADS
    reportCounts(unit, unitIndex, local);
#endif
}
