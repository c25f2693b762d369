// A round: each cell of the list is raised, with the levels around it as they are, until it is stable. Neighbours that it
// could raise then go to the next round's list. Levels only grow and each is some neighbour's less the loss, so that neither
// the order of work groups nor neighbours read before or after they changed matter: who changed late puts its neighbour down.
#include "terrane/light_gpu/cells.glsl"
#include "terrane/light_gpu/work_list.glsl"

layout(local_size_x = 256) in;

layout(location = 1) uniform uint thisRound;  // counted on over all that the host gives at once

// The cell and one word around it: x fastest, 6 × 10 × 10 words.
const uint kRow = 6u, kLayer = 60u, kTile = 600u;
shared uint tile[kTile];
shared uint changed[3];  // by iteration, in turn
shared uint raisedSides;

uint wordAround(ivec3 cell, uint place) {
    ivec3 word = ivec3(place % kRow, place / kRow % 10u, place / kLayer) - 1;
    ivec3 from = cell + ivec3(word.x >> 2, word.y >> 3, word.z >> 3);
    if (!isInside(from)) return 0u;
    return levels[wordIndex(cellIndex(uvec3(from)), uvec3(word & ivec3(3, 7, 7)))];
}

uint lossHere(uvec3 cell, uvec3 word) {
    uint chunk = cell.x / 2u + areaChunks.x * (cell.y / 2u);
    uvec3 block = (cell * kCellSize + uvec3(2u * word.x, word.yz)) % uvec3(kChunkSize, kChunkSize, kChunkHeight);
    uint low = lossOfOpacity(opacityOf(propertyAt(chunk, block)));
    uint high = lossOfOpacity(opacityOf(propertyAt(chunk, block + uvec3(1u, 0u, 0u))));
    return low * 0x0101u | high * 0x01010000u;
}

uint raised(uint now, uint at, uint loss) {
    uint west = now << 16 | tile[at - 1u] >> 16, east = now >> 16 | tile[at + 1u] << 16;
    uint brightest = maxLevels(maxLevels(west, east), maxLevels(tile[at - kRow], tile[at + kRow]));
    brightest = maxLevels(brightest, maxLevels(tile[at - kLayer], tile[at + kLayer]));
    return maxLevels(now, lessLevels(brightest, loss));
}

// Bit k: side k of the cell has this word, and it could raise the one beyond.
uint sidesRaised(uint now, uint at, uvec3 word) {
    uint sides = 0u;
    if (word.x == 0u && couldRaise(now & 0xFFFFu, tile[at - 1u] >> 16)) sides |= 1u;
    if (word.x == 3u && couldRaise(now >> 16, tile[at + 1u] & 0xFFFFu)) sides |= 2u;
    if (word.y == 0u && couldRaise(now, tile[at - kRow])) sides |= 4u;
    if (word.y == 7u && couldRaise(now, tile[at + kRow])) sides |= 8u;
    if (word.z == 0u && couldRaise(now, tile[at - kLayer])) sides |= 16u;
    if (word.z == 7u && couldRaise(now, tile[at + kLayer])) sides |= 32u;
    return sides;
}

void putDown(ivec3 cell) {
    if (!isInside(cell)) return;
    uint index = cellIndex(uvec3(cell));
    if ((cells[index] & kCellIsOpaque) != 0u) return;
    bool isThere = atomicExchange(lists[2u * cellCount() + index], thisRound + 1u) == thisRound + 1u;
    if (!isThere) addToList(thisRound % kSolverRounds + 1u, index);
}

void main() {
    uint local = gl_LocalInvocationIndex, cell = cellOfList(thisRound % kSolverRounds, gl_WorkGroupID.x);
    uvec3 place = cellPlace(cell), word = uvec3(local & 3u, local >> 2 & 7u, local >> 5);
    for (uint k = local; k < kTile; k += kCellWords) tile[k] = wordAround(ivec3(place), k);
    if (local < 3u) changed[local] = 0u;
    if (local == 3u) raisedSides = 0u;
    barrier();

    uint at = word.x + 1u + kRow * (word.y + 1u) + kLayer * (word.z + 1u);
    uint loss = lossHere(place, word), first = tile[at], now = first;
    for (uint turn = 0u;; turn = (turn + 1u) % 3u) {
        uint next = raised(now, at, loss);
        barrier();  // all have read
        if (next != now) {
            tile[at] = now = next;
            changed[turn] = 1u;
        }
        if (local == 0u) changed[(turn + 1u) % 3u] = 0u;
        barrier();
        if (changed[turn] == 0u) break;
    }

    // In the first round sources count as changes, which nobody has put neighbours down for yet; those that they could
    // raise are in the list already.
    if (now != first) {
        levels[wordIndex(cell, word)] = now;
        atomicOr(raisedSides, sidesRaised(now, at, word));
    }
    barrier();
    if (local < 6u && (raisedSides >> local & 1u) != 0u) putDown(ivec3(place) + kSides[local]);
}
