// One round: raises each light tile of the list, with the levels around it as they are, until it is stable. Neighbors
// that it could raise are added to the next round's list. Levels only grow, and each is a source or that of a neighbor
// less the loss. So neither the order of work groups nor reading a neighbor before or after its change matters: a tile
// that changes late lists its neighbors.
#include "terrane/light_gpu/light_tiles.glsl"
#include "terrane/light_gpu/work_list.glsl"

layout(local_size_x = 256) in;

layout(location = 0) uniform uint thisRound;  // counted over all submissions

// The tile with a halo of one word: x fastest, 6 × 10 × 10 words.
const uint kHaloRow = 6u, kHaloLayer = 60u, kHaloWords = 600u;
shared uint tileWithHalo[kHaloWords];
shared uint tilesBeside[6];  // by side
shared uint changed[3];  // by iteration, in turn
shared uint raisedSides;

uint wordAround(uint tile, uint place) {
    ivec3 word = ivec3(place % kHaloRow, place / kHaloRow % 10u, place / kHaloLayer) - 1;
    ivec3 away = ivec3(word.x >> 2, word.y >> 3, word.z >> 3), axes = abs(away);
    if (axes.x + axes.y + axes.z > 1) return 0u;  // edges and corners are not read
    uint from = tile;
    if (axes != ivec3(0)) {
        uint side = uint(2 * axes.y + 4 * axes.z) + (away.x + away.y + away.z > 0 ? 1u : 0u);
        from = tilesBeside[side];
        if (from == kNoTile) return 0u;
    }
    return levels[wordIndex(from, uvec3(word & ivec3(3, 7, 7)))];
}

uint lossHere(TilePlace tile, uvec3 word) {
    uvec3 block = tileCorner(tile) + uvec3(2u * word.x, word.yz);
    uint low = lossOfOpacity(opacityOf(propertyAt(tile.chunk, block)));
    uint high = lossOfOpacity(opacityOf(propertyAt(tile.chunk, block + uvec3(1u, 0u, 0u))));
    return low * 0x0101u | high * 0x01010000u;
}

uint raised(uint now, uint at, uint loss) {
    uint west = now << 16 | tileWithHalo[at - 1u] >> 16, east = now >> 16 | tileWithHalo[at + 1u] << 16;
    uint brightest = maxLevels(maxLevels(west, east), maxLevels(tileWithHalo[at - kHaloRow], tileWithHalo[at + kHaloRow]));
    brightest = maxLevels(brightest, maxLevels(tileWithHalo[at - kHaloLayer], tileWithHalo[at + kHaloLayer]));
    return maxLevels(now, lessLevels(brightest, loss));
}

// Bit k: the word is on side k of the light tile, and could raise the word beyond.
uint sidesRaised(uint now, uint at, uvec3 word) {
    uint sides = 0u;
    if (word.x == 0u && couldRaise(now & 0xFFFFu, tileWithHalo[at - 1u] >> 16)) sides |= 1u;
    if (word.x == 3u && couldRaise(now >> 16, tileWithHalo[at + 1u] & 0xFFFFu)) sides |= 2u;
    if (word.y == 0u && couldRaise(now, tileWithHalo[at - kHaloRow])) sides |= 4u;
    if (word.y == 7u && couldRaise(now, tileWithHalo[at + kHaloRow])) sides |= 8u;
    if (word.z == 0u && couldRaise(now, tileWithHalo[at - kHaloLayer])) sides |= 16u;
    if (word.z == 7u && couldRaise(now, tileWithHalo[at + kHaloLayer])) sides |= 32u;
    return sides;
}

void listTile(uint tile) {
    if (tile == kNoTile || (tiles[tile] & kTileIsOpaque) != 0u) return;
    bool isThere = atomicExchange(lists[2u * tileCount() + tile], thisRound + 1u) == thisRound + 1u;
    if (!isThere) addToList(thisRound % kSolverRounds + 1u, tile);
}

void main() {
    TilePlace place = tileOfList(thisRound % kSolverRounds, gl_WorkGroupID.x);
    uint local = gl_LocalInvocationIndex, tile = indexOf(place);
    uvec3 word = uvec3(local & 3u, local >> 2 & 7u, local >> 5);
    if (local < 6u) tilesBeside[local] = tileBeside(place, local);
    if (local < 3u) changed[local] = 0u;
    if (local == 3u) raisedSides = 0u;
    barrier();
    for (uint k = local; k < kHaloWords; k += kLightTileWords) tileWithHalo[k] = wordAround(tile, k);
    barrier();

    uint at = word.x + 1u + kHaloRow * (word.y + 1u) + kHaloLayer * (word.z + 1u);
    uint loss = lossHere(place, word), first = tileWithHalo[at], now = first;
    for (uint turn = 0u;; turn = (turn + 1u) % 3u) {
        uint next = raised(now, at, loss);
        barrier();  // all have read
        if (next != now) {
            tileWithHalo[at] = now = next;
            changed[turn] = 1u;
        }
        if (local == 0u) changed[(turn + 1u) % 3u] = 0u;
        barrier();
        if (changed[turn] == 0u) break;
    }

    // In the first round the neighbors that sources could raise are listed already.
    if (now != first) {
        levels[wordIndex(tile, word)] = now;
        atomicOr(raisedSides, sidesRaised(now, at, word));
    }
    barrier();
    if (local < 6u && (raisedSides >> local & 1u) != 0u) listTile(tilesBeside[local]);
}
