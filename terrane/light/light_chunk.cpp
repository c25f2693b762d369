#include "terrane/light/light_chunk.h"

#include <algorithm>
#include <cstring>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/light/kernels_internal.h"

namespace terrane::light {
namespace {

constexpr LightValue kOpaque = allComponents(kMaxLevel);

bool isUniformly(const BrickView& brick, LightValue value) {
    return brick.isUniform && brick.uniformValue() == value;
}

// Marks the rows that may not be settled in a chunk of which only the sources are known. Inside a brick of
// one value no light flows.
void markUnsettled(LightField& field, const ChunkBricks& bricks) {
    for (std::size_t k = 0; k < bricks.size(); ++k) {
        const BrickRun& run = bricks[k];
        if (isUniformly(run.opacity, kOpaque)) continue;
        if (!run.light.isUniform) {
            field.markAll(field.find(kCenterChunk, run.highest));
            continue;
        }
        const auto differs = [&](const BrickRun& other) {
            return !isUniformly(other.light, run.light.uniformValue());
        };
        if (k > 0 && differs(bricks[k - 1]))
            field.markLayer(field.find(kCenterChunk, run.highest), world::kSectionSize - 1);
        if (k + 1 < bricks.size() && differs(bricks[k + 1]))
            field.markLayer(field.find(kCenterChunk, run.lowest), 0);
    }
}

int addBrick(LightField& field, int chunk, int number, const BrickRun& run) {
    const int index = field.add(chunk, number);
    field.brick(index).light = run.light;
    field.brick(index).opacity = run.opacity.values;
    return index;
}

// Adds the highest and the lowest brick of each run to the field. The light of those between does not change:
// as far as light reaches, 14 blocks, all sources are equal.
void addEnds(LightField& field, const ChunkBricks& bricks) {
    for (const BrickRun& run : bricks) {
        addBrick(field, kCenterChunk, run.highest, run);
        if (run.lowest != run.highest) addBrick(field, kCenterChunk, run.lowest, run);
    }
}

// The runs after the light of their ends has changed in the field.
ChunkBricks changedRuns(LightField& field, const ChunkBricks& bricks) {
    ChunkBricks result;
    result.reserve(bricks.size() + 8);
    const auto push = [&](int highest, int lowest, BrickView light, BrickView opacity) {
        light.writable = opacity.writable = nullptr;
        result.push_back({highest, lowest, light, opacity});
    };
    for (const BrickRun& run : bricks) {
        const BrickView upper = field.brick(field.find(kCenterChunk, run.highest)).light;
        const BrickView lower = field.brick(field.find(kCenterChunk, run.lowest)).light;
        if (run.highest == run.lowest) {
            push(run.highest, run.lowest, upper, run.opacity);
            continue;
        }
        int highest = run.highest, lowest = run.lowest;
        if (!upper.isUniform) push(highest, highest, upper, run.opacity), --highest;
        if (!lower.isUniform) ++lowest;
        if (highest >= lowest) push(highest, lowest, run.light, run.opacity);
        if (!lower.isUniform) push(run.lowest, run.lowest, lower, run.opacity);
    }
    return result;
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
    if (std::memcmp(east, west, sizeof(LocalLight::SideLevels)) == 0) return;
    const int upper = field.brick(lower).beside[kEast];
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
    const int upper = field.brick(lower).beside[kNorth];
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

std::vector<LocalLight::Run> withSides(const ChunkBricks& bricks,
                                       std::vector<LocalLight::SideLevels>& owned) {
    const auto isUniform = [](const BrickRun& run) { return run.light.isUniform; };
    const auto uniform = std::count_if(bricks.begin(), bricks.end(), isUniform);
    owned.resize(2 * (bricks.size() - static_cast<std::size_t>(uniform)));
    LocalLight::SideLevels* next = owned.data();
    std::vector<LocalLight::Run> runs;
    runs.reserve(bricks.size());
    for (const BrickRun& run : bricks) {
        const LightValue* values = run.light.values;
        if (run.light.isUniform) {
            runs.push_back({run, values, values});  // any 256 values of a uniform brick
            continue;
        }
        LocalLight::SideLevels &west = *next++, &east = *next++;
        for (std::size_t row = 0; row < west.size(); ++row) {
            west[row] = values[16 * row];
            east[row] = values[16 * row + 15];
        }
        runs.push_back({run, west.data(), east.data()});
    }
    return runs;
}

// The runs of 3×3 chunks at one height, which is lowered from the top.
class RunsAround {
  public:
    explicit RunsAround(const LocalLightNeighborhood& chunks) {
        for (std::size_t k = 0; k < chunks.size(); ++k)
            runs_[k] = chunks[k] ? chunks[k]->runs.data() : nullptr;
    }

    // Returns the run of a chunk at this height, or null if the chunk is unknown.
    const LocalLight::Run* of(int chunk) const { return runs_[static_cast<std::size_t>(chunk)]; }
    // Returns the lowest height at which all runs are the same as here.
    int lowest() const {
        int lowest = world::kLowestSection;
        for (const LocalLight::Run* run : runs_)
            if (run) lowest = std::max(lowest, run->bricks.lowest);
        return lowest;
    }
    void lowerTo(int number) {
        for (const LocalLight::Run*& run : runs_)
            while (run && run->bricks.lowest > number) ++run;
    }

  private:
    std::array<const LocalLight::Run*, kFieldChunks> runs_{};
};

// Calls f(chunk, other, side) for the twelve borders between 3×3 chunks: `other` is on the side kEast or
// kNorth of `chunk`.
template <class Function>
void forEachBorder(Function f) {
    for (int chunk = 0; chunk < kFieldChunks; ++chunk) {
        if (chunk % kFieldSide < 2) f(chunk, chunk + 1, kEast);
        if (chunk / kFieldSide < 2) f(chunk, chunk + kFieldSide, kNorth);
    }
}

// Returns true if surely no light passes between two bricks beside each other: in both directions it is no
// brighter or the other is opaque.
bool isSettled(const BrickRun& a, const BrickRun& b) {
    if (isUniformly(a.opacity, kOpaque) && isUniformly(b.opacity, kOpaque)) return true;
    if (!a.light.isUniform || !b.light.isUniform) return false;
    const LightValue lightA = a.light.uniformValue(), lightB = b.light.uniformValue();
    if (lightA == lightB) return true;
    const auto enters = [](LightValue from, LightValue to, const BrickView& opacity) {
        return !opacity.isUniform || flows(from, to, opacity.uniformValue(), kDark);
    };
    return !enters(lightA, lightB, b.opacity) && !enters(lightB, lightA, a.opacity);
}

// Returns the heights at which light may pass from chunk to chunk. Runs are looked at once, however high.
world::SectionSet findUnsettled(const LocalLightNeighborhood& chunks) {
    const world::Heights heights = chunks[kCenterChunk]->heights;
    world::SectionSet unsettled;
    RunsAround around(chunks);
    for (int number = heights.endSection() - 1; number >= heights.firstSection();) {
        around.lowerTo(number);
        const int lowest = around.lowest();
        bool isUnsettled = false;
        forEachBorder([&](int chunk, int other, Side) {
            const LocalLight::Run *a = around.of(chunk), *b = around.of(other);
            if (a && b && !isSettled(a->bricks, b->bricks)) isUnsettled = true;
        });
        for (; number >= lowest; --number)
            if (isUnsettled) unsettled.add(number);
    }
    return unsettled;
}

// Adds the bricks at these heights and one above and below, which light reaches too, to the field.
void addAround(LightField& field, const LocalLightNeighborhood& chunks, const world::SectionSet& unsettled) {
    const world::Heights heights = chunks[kCenterChunk]->heights;
    const auto has = [&](int number) {
        return heights.contains(number * world::kSectionSize) && unsettled.has(number);
    };
    RunsAround around(chunks);
    for (int number = heights.endSection() - 1; number >= heights.firstSection(); --number) {
        if (!has(number) && !has(number - 1) && !has(number + 1)) continue;
        around.lowerTo(number);
        for (int chunk = 0; chunk < kFieldChunks; ++chunk) {
            if (const LocalLight::Run* run = around.of(chunk))
                field.brick(addBrick(field, chunk, number, run->bricks)).reach = reachOf(chunk);
        }
    }
}

void markBorders(LightField& field, const LocalLightNeighborhood& chunks,
                 const world::SectionSet& unsettled) {
    const world::Heights heights = chunks[kCenterChunk]->heights;
    RunsAround around(chunks);
    for (int number = heights.endSection() - 1; number >= heights.firstSection(); --number) {
        if (!unsettled.has(number)) continue;
        around.lowerTo(number);
        forEachBorder([&](int chunk, int other, Side side) {
            const LocalLight::Run *a = around.of(chunk), *b = around.of(other);
            if (!a || !b) return;
            const int index = field.find(chunk, number);
            if (side == kEast)
                markBorderX(field, index, a->east, b->west);
            else
                markBorderY(field, index);
        });
    }
}

}  // namespace

LocalLight solveLocal(const world::Chunk& chunk, const LightTable& table, LightScratch& scratch) {
    TERRANE_ZONE("light local");
    LightField& field = scratch.field;
    field.reset();
    const ChunkBricks sources = findSources(chunk, table, field.pool());
    addEnds(field, sources);
    markUnsettled(field, sources);
    raiseLight(field);
    LocalLight result;
    result.heights = chunk.heights();
    result.runs = withSides(changedRuns(field, sources), result.ownedSides);
    result.owned = field.pool().release();
    return result;
}

ChunkLight lightChunk(const LocalLightNeighborhood& chunks, LightScratch& scratch) {
    TERRANE_ZONE("light chunk");
    base::require(chunks[kCenterChunk] != nullptr, "lightChunk: the chunk to light, in the middle, is null");
    const LocalLight& center = *chunks[kCenterChunk];
    for (const LocalLight* local : chunks)
        base::require(!local || local->heights == center.heights, "lightChunk: the heights differ");
    LightField& field = scratch.field;
    field.reset();
    const world::SectionSet unsettled = findUnsettled(chunks);
    addAround(field, chunks, unsettled);
    markBorders(field, chunks, unsettled);
    raiseLight(field);
    ChunkLight result(center.heights);
    for (const LocalLight::Run& run : center.runs) {
        for (int number = run.bricks.highest; number >= run.bricks.lowest; --number) {
            const int index = field.find(kCenterChunk, number);
            result.setBrick(number, packBrick(index == 0 ? run.bricks.light : field.brick(index).light));
        }
    }
    return result;
}

}  // namespace terrane::light
