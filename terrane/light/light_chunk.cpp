#include "terrane/light/light_chunk.h"

#include <algorithm>
#include <cstring>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/light/kernels_internal.h"

namespace terrane::light {
namespace {

constexpr int kBricks = world::kSectionsPerChunk;
constexpr LightValue kOpaque = allComponents(kMaxLevel);

void addChunk(LightField& field, int chunk, const ChunkBricks& bricks) {
    for (int number = 0; number < kBricks; ++number) {
        FieldBrick& brick = field.brick(chunk, number);
        brick.light = bricks.light[static_cast<std::size_t>(number)];
        brick.opacity = bricks.opacity[static_cast<std::size_t>(number)].values;
        brick.isInside = true;
    }
}

// Marks the rows that may not be settled in a chunk of which only the sources are known. Inside a brick of
// one value no light flows.
void markUnsettled(LightField& field, const ChunkBricks& bricks) {
    for (int number = 0; number < kBricks; ++number) {
        const auto k = static_cast<std::size_t>(number);
        const BrickView opacity = bricks.opacity[k];
        if (opacity.isUniform && opacity.uniformValue() == kOpaque) continue;
        const int index = LightField::indexOf(kCenterChunk, number);
        if (!bricks.light[k].isUniform) {
            field.markAll(index);
            continue;
        }
        const auto differs = [&](std::size_t other) {
            return !bricks.light[other].isUniform ||
                   bricks.light[other].uniformValue() != bricks.light[k].uniformValue();
        };
        if (number > 0 && differs(k - 1)) field.markLayer(index, 0);
        if (number + 1 < kBricks && differs(k + 1)) field.markLayer(index, world::kSectionSize - 1);
    }
}

// Distance of each column of a chunk of the field to the middle chunk: light of that level or less cannot
// reach it.
using Reach = std::array<LightValue, world::kChunkSize * world::kChunkSize>;

std::array<Reach, kFieldChunks> makeReaches() {
    const auto distance = [](int chunk, int i) { return chunk == 0 ? 16 - i : chunk == 1 ? 0 : i + 1; };
    std::array<Reach, kFieldChunks> reaches;
    for (int chunk = 0; chunk < kFieldChunks; ++chunk) {
        for (int column = 0; column < 256; ++column) {
            const int away =
                distance(chunk % kFieldSide, column & 15) + distance(chunk / kFieldSide, column >> 4);
            reaches[static_cast<std::size_t>(chunk)][static_cast<std::size_t>(column)] =
                allComponents(std::min(away, kMaxLevel));
        }
    }
    return reaches;
}

const LightValue* reachOf(int chunk) {
    static const std::array<Reach, kFieldChunks> reaches = makeReaches();
    return reaches[static_cast<std::size_t>(chunk)].data();
}

// Whether light passes from one voxel to its neighbor and can reach the middle chunk. Handles four levels at
// once: two to a number, in bytes whose highest bit is set if the difference is not negative.
bool flows(LightValue from, LightValue to, LightValue opacity, LightValue reach) {
    const auto reaches = [&](int shift) {
        const auto part = [&](LightValue v) { return static_cast<unsigned>(v >> shift) & 0x0F0Fu; };
        const unsigned offered = (part(from) | 0x8080u) - part(opacity) - 0x0202u;
        return (offered - part(to)) & (offered - part(reach)) & 0x8080u;
    };
    return (reaches(0) | reaches(4)) != 0;
}

// Marks the rows into which light flows across a border between bricks in x; `lower` is the brick at the
// lower x.
void markBorderX(LightField& field, int lower, const LightValue* east, const LightValue* west) {
    if (std::memcmp(east, west, sizeof(LocalLight::Side)) == 0) return;
    const int upper = lower + LightField::kStepX;
    const FieldBrick &a = field.brick(lower), &b = field.brick(upper);
    for (int row = 0; row < kRowsPerBrick; ++row) {
        if (east[row] == west[row]) continue;
        const int first = 16 * row, last = first + 15, y = row & 15;
        if (flows(west[row], east[row], a.opacity[last], a.reach[16 * y + 15])) field.markRow(lower, row);
        if (flows(east[row], west[row], b.opacity[first], b.reach[16 * y])) field.markRow(upper, row);
    }
}

// The same for a border in y. Rows lie along the border there, and are marked where they differ.
void markBorderY(LightField& field, int lower) {
    const int upper = lower + LightField::kStepY;
    const BrickView a = field.brick(lower).light, b = field.brick(upper).light;
    if (a.isUniform && b.isUniform && a.uniformValue() == b.uniformValue()) return;
    for (int z = 0; z < world::kSectionSize; ++z) {
        const LightValue* rowA = a.values + 256 * z + 240;
        const LightValue* rowB = b.values + 256 * z;
        if (std::equal(rowA, rowA + 16, rowB)) continue;
        field.markRow(lower, 16 * z + 15);
        field.markRow(upper, 16 * z);
    }
}

void addSides(LocalLight& local) {
    const auto isUniform = [](const BrickView& brick) { return brick.isUniform; };
    const auto& light = local.bricks.light;
    const auto uniform = std::count_if(light.begin(), light.end(), isUniform);
    local.ownedSides.resize(2 * (light.size() - static_cast<std::size_t>(uniform)));
    LocalLight::Side* next = local.ownedSides.data();
    for (std::size_t k = 0; k < light.size(); ++k) {
        local.west[k] = local.east[k] = light[k].values;  // any 256 values of a uniform brick
        if (light[k].isUniform) continue;
        LocalLight::Side &west = *next++, &east = *next++;
        for (std::size_t row = 0; row < west.size(); ++row) {
            west[row] = light[k].values[16 * row];
            east[row] = light[k].values[16 * row + 15];
        }
        local.west[k] = west.data();
        local.east[k] = east.data();
    }
}

void markBorders(LightField& field, const LocalLightNeighborhood& chunks) {
    for (int chunk = 0; chunk < kFieldChunks; ++chunk) {
        const auto isThere = [&](int other) { return chunks[static_cast<std::size_t>(other)] != nullptr; };
        if (!isThere(chunk)) continue;
        const bool hasEast = chunk % kFieldSide < 2 && isThere(chunk + 1);
        const bool hasNext = chunk / kFieldSide < 2 && isThere(chunk + kFieldSide);
        for (int number = 0; number < kBricks; ++number) {
            const int index = LightField::indexOf(chunk, number);
            if (hasEast) {
                const auto at = static_cast<std::size_t>(number);
                markBorderX(field, index, chunks[static_cast<std::size_t>(chunk)]->east[at],
                            chunks[static_cast<std::size_t>(chunk + 1)]->west[at]);
            }
            if (hasNext) markBorderY(field, index);
        }
    }
}

}  // namespace

LocalLight solveLocal(const world::Chunk& chunk, const LightTable& table, LightScratch& scratch) {
    TERRANE_ZONE("light local");
    LightField& field = scratch.field;
    field.reset();
    LocalLight result;
    result.bricks = findSources(chunk, table, field.pool());
    addChunk(field, kCenterChunk, result.bricks);
    markUnsettled(field, result.bricks);
    raiseLight(field);
    for (int number = 0; number < kBricks; ++number) {
        BrickView& light = result.bricks.light[static_cast<std::size_t>(number)];
        light = field.brick(kCenterChunk, number).light;
        light.writable = nullptr;
        result.bricks.opacity[static_cast<std::size_t>(number)].writable = nullptr;
    }
    result.owned = field.pool().release();
    addSides(result);
    return result;
}

ChunkLight lightChunk(const LocalLightNeighborhood& chunks, LightScratch& scratch) {
    TERRANE_ZONE("light chunk");
    base::require(chunks[kCenterChunk] != nullptr, "lightChunk: the chunk to light, in the middle, is null");
    LightField& field = scratch.field;
    field.reset();
    for (int chunk = 0; chunk < kFieldChunks; ++chunk) {
        if (const LocalLight* local = chunks[static_cast<std::size_t>(chunk)]) {
            addChunk(field, chunk, local->bricks);
            for (int number = 0; number < kBricks; ++number)
                field.brick(chunk, number).reach = reachOf(chunk);
        }
    }
    markBorders(field, chunks);
    raiseLight(field);
    ChunkLight result;
    for (int number = 0; number < kBricks; ++number) {
        result.setBrick(number, packBrick(field.brick(kCenterChunk, number).light));
    }
    return result;
}

}  // namespace terrane::light
