// The cells of the first round: those that are not even, or that a neighbour's sources could raise. Left out are the open
// sky, the dark and what lets no light in.
#include "terrane/light_gpu/cells.glsl"
#include "terrane/light_gpu/work_list.glsl"

layout(local_size_x = 64) in;

void main() {
    uint cell = gl_GlobalInvocationID.x;
    if (cell >= cellCount()) return;
    lists[2u * cellCount() + cell] = 0u;
    uint summary = cells[cell];
    if ((summary & kCellIsOpaque) != 0u) return;
    bool isWorthALook = (summary & kCellIsUniform) == 0u;
    for (uint side = 0u; side < 6u && !isWorthALook; ++side) {
        uint beside = cellBeside(cell, side);
        isWorthALook = beside != kNoCell && couldRaise(cells[beside] & 0xFFFFu, summary & 0xFFFFu);
    }
    if (isWorthALook) addToList(0u, cell);
}
