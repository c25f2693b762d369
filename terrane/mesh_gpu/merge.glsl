// Merges the faces of 96 planes, 16 of each side, into rectangles. The pairs of neighboring faces that may merge are
// found before, for all planes at once; merging then uses bits only.
#include "terrane/mesh_gpu/quads.glsl"
#include "terrane/shared/merge_passes.h"

layout(location = 0) uniform uint method;  // kMerge…

// By side, then row·16 + plane: faces of the same kind as the one before them in their row; << 16: as the one in the
// row before.
shared uint sameKind[6u * kBlocksPerLayer];
// The same for faces that belong to one rectangle already, while rectangles are merged.
shared uint merged[6u * kBlocksPerLayer];

// Faces of one kind have the same block type; those of a liquid are all at its surface or all below it.
uint kindOf(uint side, uvec3 cell) {
    uint isSurface = side < 4u ? surface[cell.y + kSectionSize * cell.z] >> cell.x & 1u : 0u;
    return idAt(cell) | isSurface << 16;
}

// local: row·16 + plane
void compareKinds(uint side, uint local) {
    uint at = kBlocksPerLayer * side + local;
    uint seen = faces[at], before = local < kSectionSize ? 0u : faces[at - kSectionSize];
    uint same = 0u, kindBefore = 0u;
    for (uint left = seen; left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left)), kind = kindOf(side, cellOf(side, local % kSectionSize, local / kSectionSize, bit));
        bool doesMerge = (types[typeOf(kind & 0xFFFFu)].flags >> (kMeshMergesShift + side) & 1u) != 0u;
        if (doesMerge && (seen << 1 >> bit & 1u) != 0u && kind == kindBefore) same |= 1u << bit;
        if (doesMerge && (before >> bit & 1u) != 0u &&
            kind == kindOf(side, cellOf(side, local % kSectionSize, local / kSectionSize - 1u, bit))) {
            same |= 0x10000u << bit;
        }
        kindBefore = kind;
    }
    sameKind[at] = same;
}

// Greedy merging. Returns the number of rows that contain the run of faces, all of the same kind; `first` is the place
// of its row. A row where that kind continues beyond both ends of the run is not taken, since it would be cut in three.
// Rows after the first lose the run.
uint takeRows(uint first, uint row, uint run) {
    uint rows = 1u, lowest = run & (0u - run), after = run + lowest;
    for (uint at = first + kSectionSize; row + rows < kSectionSize; at += kSectionSize, ++rows) {
        uint seen = faces[at], same = sameKind[at];
        if ((seen & run) != run || (same >> 16 & run) != run) break;
        bool goesOnBefore = (same & lowest) != 0u && (seen & lowest >> 1) != 0u;
        if (goesOnBefore && (same & after) != 0u && (seen & after) != 0u) break;
        faces[at] = seen ^ run;
    }
    return rows;
}

void mergeGreedily(MeshUnit unit, uint side, uint plane) {
    for (uint row = 0u; row < kSectionSize; ++row) {
        uint at = kBlocksPerLayer * side + kSectionSize * row + plane, left = faces[at], same = sameKind[at] & 0xFFFFu;
        while (left != 0u) {
            uint lowest = left & (0u - left), bit = uint(findLSB(left));
            // Adding the lowest face to the faces that continue a run carries through the run.
            uint goesOn = left & same & ~lowest | lowest;
            uint run = goesOn & ~(goesOn + lowest);
            left ^= run;
            uint rows = takeRows(at, row, run);
            addFaces(unit, side, cellOf(side, plane, row, bit), uvec2(bitCount(run), rows));
        }
    }
}

// The other methods. `at`: index of a row in `merged`. A rectangle is named by its lowest face.
uint lowestFaces(uint at) {
    return faces[at] & ~(merged[at] | merged[at] >> 16);
}
uint bitsOf(uint at, uint bit) {
    return 1u + uint(findLSB(~(merged[at] & 0xFFFFu) >> bit >> 1));
}
uint rowsOf(uint at, uint bit) {
    uint rows = 1u;
    uint row = at % kBlocksPerLayer / kSectionSize;
    while (row + rows < kSectionSize && (merged[at + kSectionSize * rows] >> bit >> 16 & 1u) != 0u) ++rows;
    return rows;
}

bool mayMerge(uint pass, uint end, uint length) {
    bool isAtLine = (mergeLines(pass) >> end & 1u) != 0u;
    return isAtLine && (mergeLength(pass) == 0u || length == mergeLength(pass));
}

// Merges rectangles that begin in one row, in the order of their bits: no other invocation changes them.
void mergeAlongRow(uint pass, uint at) {
    for (uint left = lowestFaces(at); left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left)), bits = bitsOf(at, bit), rows = rowsOf(at, bit);
        for (uint end = bit + bits; end < kSectionSize; end = bit + bits) {
            if ((sameKind[at] & lowestFaces(at) & 1u << end) == 0u || rowsOf(at, end) != rows) break;
            if (!mayMerge(pass, end, bits)) break;
            uint nextBits = bitsOf(at, end);
            for (uint k = 0u; k < rows; ++k) atomicOr(merged[at + kSectionSize * k], 1u << end);
            left &= ~(1u << end);
            bits += nextBits;
        }
    }
}

// The same for one column: `first` is the index of the plane's first row.
void mergeAcrossRows(uint pass, uint first, uint bit) {
    for (uint row = 0u; row < kSectionSize;) {
        uint at = first + kSectionSize * row;
        if ((lowestFaces(at) >> bit & 1u) == 0u) {
            ++row;
            continue;
        }
        uint bits = bitsOf(at, bit), rows = rowsOf(at, bit);
        while (row + rows < kSectionSize) {
            uint next = at + kSectionSize * rows;
            if ((sameKind[next] >> 16 & lowestFaces(next) & 1u << bit) == 0u || bitsOf(next, bit) != bits) break;
            if (!mayMerge(pass, row + rows, rows)) break;
            uint nextRows = rowsOf(next, bit);
            atomicOr(merged[next], ((1u << bits) - 1u) << bit << 16);
            rows += nextRows;
        }
        row += rows;
    }
}

// Run by the whole work group; each row and each column of each plane has its own invocation.
void mergeInPasses(MeshUnit unit, uint local) {
    for (uint side = 0u; side < 6u; ++side) merged[kBlocksPerLayer * side + local] = 0u;
    barrier();
    for (uint pass = firstMergePass(method); pass < endOfMergePasses(method); ++pass) {
        for (uint side = 0u; side < 6u; ++side) {
            if (pass % 2u == 0u) {
                mergeAlongRow(pass, kBlocksPerLayer * side + local);
            } else {
                mergeAcrossRows(pass, kBlocksPerLayer * side + local % kSectionSize, local / kSectionSize);
            }
        }
        barrier();
    }
    for (uint side = 0u; side < 6u; ++side) {
        uint at = kBlocksPerLayer * side + local;
        for (uint left = lowestFaces(at); left != 0u; left &= left - 1u) {
            uint bit = uint(findLSB(left));
            uvec3 cell = cellOf(side, local % kSectionSize, local / kSectionSize, bit);
            addFaces(unit, side, cell, uvec2(bitsOf(at, bit), rowsOf(at, bit)));
        }
    }
}
