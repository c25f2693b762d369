// Faces of flowing liquids, one quad a face: the rules of mesh/model_faces.cpp. Needs quads.glsl.

const uint kStillHeight = kFlowHeights - 1u;

struct LiquidBeside {
    bool isSame;
    uint form;
    bool isStillFull;
};

// Whether the top of a still block is not a surface. The block above is unknown at the top of a section in a
// neighboring chunk: the top counts as a surface then.
bool isStillFull(MeshUnit unit, uint section, uvec3 inside, uint id) {
    bool isTop = inside.z == kLast;
    if (isTop && section != unit.section) return false;
    uint above = blockBeyond(isTop ? unit.neighbors[5] : section, uvec3(inside.xy, (inside.z + 1u) & kLast));
    return (above & 0xFFFFu) == id || (above >> 16 & kMeshOpaqueBit) != 0u;
}

LiquidBeside liquidBeside(MeshUnit unit, uvec3 cell, uint side) {
    ivec3 at = ivec3(cell) + kToward[side];
    uvec3 inside = uvec3(at & int(kLast));
    if (idBeside(unit, cell, side) != idAt(cell)) return LiquidBeside(false, 0u, false);
    bool isInside = all(equal(ivec3(inside), at));
    uint form = blockStateAt(isInside ? unit.blockState : unit.neighborStates[side], blockIndex(inside)) & kMeshFlowMask;
    uint section = isInside ? unit.section : unit.neighbors[side];
    return LiquidBeside(true, form, form == 0u && isStillFull(unit, section, inside, idAt(cell)));
}

uint flowHeightOf(uint form, bool isStillFull) {
    if (form == 0u) return isStillFull ? kFlowHeights : kStillHeight;
    return (form & kMeshFlowFalling) != 0u ? kFlowHeights : kStillHeight - form;
}

void addFlowFace(MeshUnit unit, uvec3 cell, uint side, uint shapeFace) {
    addQuad(packCell(unit, cell), shapeFace, types[typeOf(idAt(cell))].faces[side], side);
#if !WRITES_QUADS
    coverLayer(cell.z);
#endif
}

void addFlowSide(MeshUnit unit, uvec3 cell, uint form, uint side) {
    if (isCovered(cell, side)) return;
    LiquidBeside next = liquidBeside(unit, cell, side);
    if (form == 0u && next.form == 0u) return;
    bool isFull = (surface[cell.y + kSectionSize * cell.z] >> cell.x & 1u) == 0u;
    uint high = flowHeightOf(form, isFull), low = next.isSame ? flowHeightOf(next.form, next.isStillFull) : 0u;
    if (low < high) addFlowFace(unit, cell, side, flowSideFace(side, low, high));
}

void addFlowLevel(MeshUnit unit, uvec3 cell, uint side) {
    bool isHidden = isCovered(cell, side) || idBeside(unit, cell, side) == idAt(cell);
    if (!isHidden) addFlowFace(unit, cell, side, kShapeFaceCube + side);
}

// Adds the faces of the liquid cells of a row.
void addFlow(MeshUnit unit, Row row, uint local) {
    uvec4 around = uvec4(unit.neighborStates[0], unit.neighborStates[1], unit.neighborStates[2], unit.neighborStates[3]);
    if (unit.blockState == kNoSection && all(equal(around, uvec4(kNoSection)))) return;
    for (uint left = row.liquid; left != 0u; left &= left - 1u) {
        uvec3 cell = uvec3(findLSB(left), local % kSectionSize, local / kSectionSize);
        uint form = blockStateAt(unit.blockState, blockIndex(cell)) & kMeshFlowMask;
        for (uint side = 0u; side < 4u; ++side) addFlowSide(unit, cell, form, side);
        if (form == 0u) continue;
        addFlowLevel(unit, cell, 4u);
        if ((form & kMeshFlowFalling) != 0u) {
            addFlowLevel(unit, cell, 5u);
        } else {
            addFlowFace(unit, cell, 5u, kShapeFaceFlowTop + form - 1u);
        }
    }
}
