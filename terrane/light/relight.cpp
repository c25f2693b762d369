#include "terrane/light/relight.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/light/kernels_internal.h"
#include "terrane/light/relight_internal.h"

namespace terrane::light {

namespace {

// The bricks that the changes can reach: in chunks firstX…lastX, firstY…lastY (0…2), bricks lowest…highest.
struct Range {
    int firstX = 1, lastX = 1, firstY = 1, lastY = 1, lowest = world::kSectionsPerChunk, highest = -1;
};

Range rangeOf(std::span<const SourceChange> changes) {
    Range range;
    for (const SourceChange& change : changes) {
        const int x = change.index & 15, y = change.index >> 4 & 15, z = change.index >> 8;
        if (x < kMaxLevel) range.firstX = 0;
        if (x + kMaxLevel >= world::kChunkSize) range.lastX = 2;
        if (y < kMaxLevel) range.firstY = 0;
        if (y + kMaxLevel >= world::kChunkSize) range.lastY = 2;
        range.lowest = std::min(range.lowest, std::max(0, z - kMaxLevel) >> 4);
        range.highest = std::max(range.highest, std::min(world::kChunkHeight - 1, z + kMaxLevel) >> 4);
    }
    return range;
}

// Calls f(chunk, brick) for bricks in range whose chunk and light are known.
template <class Function>
void forEachBrick(const LightWindow& window, const Range& range, Function f) {
    for (int cy = range.firstY; cy <= range.lastY; ++cy) {
        for (int cx = range.firstX; cx <= range.lastX; ++cx) {
            const int chunk = cx + kFieldSide * cy;
            if (!window.chunks[static_cast<std::size_t>(chunk)]) continue;
            if (!window.lights[static_cast<std::size_t>(chunk)]) continue;
            for (int brick = range.lowest; brick <= range.highest; ++brick) f(chunk, brick);
        }
    }
}

// Fills `decreaseQueue` with the old light and the new sources, without decreases.
void load(const LightWindow& window, const Range& range, const LightTable& table, LightField& decreaseQueue) {
    std::array<ChunkBricks, kFieldChunks> sources;
    forEachBrick(window, range, [&](int chunk, int number) {
        const auto c = static_cast<std::size_t>(chunk), n = static_cast<std::size_t>(number);
        if (number == range.lowest)
            sources[c] = findSources(*window.chunks[c], table, decreaseQueue.pool(), range.lowest);
        FieldBrick& brick = decreaseQueue.brick(chunk, number);
        brick.opacity = sources[c].opacity[n].values;
        brick.source = sources[c].light[n].values;
        brick.before = decreaseQueue.pool().unpack(window.lights[c]->brick(number)).values;
        brick.isInside = true;
    });
}

// Levels of a changed voxel to remove: those that lost their source, or where the block became more opaque.
LightValue decreasedLevels(const SourceChange& change, LightValue before) {
    LightValue decreased = 0;
    for (int c = 0; c < kComponentCount; ++c) {
        const int level = levelOf(before, c), source = levelOf(change.sourceAfter, c);
        const bool lostSource = source < levelOf(change.sourceBefore, c);
        if (level > source && (lostSource || change.moreOpaque)) decreased = withLevel(decreased, c, level);
    }
    return decreased;
}

int fieldIndexOf(const SourceChange& change) {
    return LightField::indexOf(kCenterChunk, change.index >> 12);
}

void findDecreases(std::span<const SourceChange> changes, LightField& decreaseQueue) {
    for (const SourceChange& change : changes) {
        const int index = fieldIndexOf(change), voxel = change.index & 4095;
        FieldBrick& brick = decreaseQueue.brick(index);
        const LightValue found = decreasedLevels(change, brick.before[voxel]);
        if (found == 0) continue;
        decreaseQueue.writable(brick)[voxel] = found;
        decreaseQueue.markAround(index, voxel);
    }
    propagateDecreases(decreaseQueue);
}

void markRows(const LightValue* decreased, int index, LightField& field) {
    for (int row = 0; row < kRowsPerBrick; ++row) {
        const LightValue* values = decreased + 16 * row;
        if (std::any_of(values, values + 16, [](LightValue v) { return v != 0; })) field.markRow(index, row);
    }
}

// Fills `field` with the light that stays: the old light without the decreased levels, with the new sources.
void keepCertain(const LightWindow& window, const Range& range, LightField& decreaseQueue,
                 LightField& field) {
    forEachBrick(window, range, [&](int chunk, int number) {
        const int index = LightField::indexOf(chunk, number);
        const FieldBrick& from = decreaseQueue.brick(index);
        FieldBrick& to = field.brick(index);
        to.opacity = from.opacity;
        to.isInside = true;
        to.light = {from.before, nullptr, false};
        if (!from.light.writable) return;
        LightValue* light = field.pool().acquire()->values.data();
        replaceDecreased(from.light.values, from.source, from.before, light);
        to.light = {light, light, false};
        markRows(from.light.values, index, field);
    });
}

void raiseSources(std::span<const SourceChange> changes, LightField& field) {
    for (const SourceChange& change : changes) {
        const int index = fieldIndexOf(change), voxel = change.index & 4095;
        FieldBrick& brick = field.brick(index);
        LightValue light = brick.light.values[voxel];
        for (int c = 0; c < kComponentCount; ++c)
            light = withLevel(light, c, std::max(levelOf(light, c), levelOf(change.sourceAfter, c)));
        if (light != brick.light.values[voxel]) {
            field.writable(brick)[voxel] = light;
            field.markAround(index, voxel);
        } else if (change.isBlock) {
            field.markRow(index, voxel >> 4);  // more light may enter than before
        }
    }
    raiseLight(field);
}

ChangedBricks store(LightWindow& window, const Range& range, LightField& decreaseQueue, LightField& field) {
    ChangedBricks changed{};
    std::array<std::shared_ptr<ChunkLight>, kFieldChunks> copies;
    forEachBrick(window, range, [&](int chunk, int number) {
        const int index = LightField::indexOf(chunk, number);
        const LightValue* light = field.brick(index).light.values;
        const LightValue* before = decreaseQueue.brick(index).before;
        if (light == before || std::memcmp(light, before, sizeof(Brick)) == 0) return;
        const auto c = static_cast<std::size_t>(chunk);
        if (!copies[c]) copies[c] = std::make_shared<ChunkLight>(*window.lights[c]);
        copies[c]->setBrick(number, packBrick({light, nullptr, false}));
        changed[c] = static_cast<std::uint16_t>(changed[c] | 1 << number);
    });
    for (std::size_t c = 0; c < copies.size(); ++c) {
        if (copies[c]) window.lights[c] = std::move(copies[c]);
    }
    return changed;
}

}  // namespace

ChangedBricks relight(LightWindow& window, std::span<const BlockChange> changes, const LightTable& table,
                      LightScratch& scratch) {
    TERRANE_ZONE("relight");
    base::require(window.chunks[kCenterChunk] && window.lights[kCenterChunk],
                  "relight: the changed chunk, in the middle, or its light is null");
    const std::vector<SourceChange> sources = findSourceChanges(*window.chunks[kCenterChunk], changes, table);
    const Range range = rangeOf(sources);
    scratch.field.reset();
    scratch.decreaseQueue.reset();
    load(window, range, table, scratch.decreaseQueue);
    findDecreases(sources, scratch.decreaseQueue);
    keepCertain(window, range, scratch.decreaseQueue, scratch.field);
    raiseSources(sources, scratch.field);
    return store(window, range, scratch.decreaseQueue, scratch.field);
}

std::vector<LightChange> relight(LitChunks& chunks, std::span<const world::BlockEdit> edits,
                                 const LightTable& table, LightScratch& scratch) {
    std::map<world::ChunkPos, std::vector<BlockChange>> byChunk;
    for (const world::BlockEdit& edit : edits)
        byChunk[world::chunkOf(edit.pos)].push_back({world::blockIndex(edit.pos), edit.before});

    std::map<world::ChunkPos, std::uint16_t> changed;
    for (const auto& [pos, changes] : byChunk) {
        LightWindow window;
        std::array<LitChunk*, kFieldChunks> around{};
        const auto offset = [&, center = pos](std::size_t k) {
            return world::offsetBy(center, static_cast<int>(k) % kFieldSide - 1,
                                   static_cast<int>(k) / kFieldSide - 1);
        };
        for (std::size_t k = 0; k < around.size(); ++k) {
            const auto found = chunks.find(offset(k));
            if (found == chunks.end()) continue;
            around[k] = &found->second;
            window.chunks[k] = found->second.chunk.get();
            window.lights[k] = found->second.light;
        }
        if (!window.chunks[kCenterChunk] || !window.lights[kCenterChunk]) continue;
        const ChangedBricks bricks = relight(window, changes, table, scratch);
        for (std::size_t k = 0; k < around.size(); ++k) {
            if (bricks[k] == 0) continue;
            around[k]->light = std::move(window.lights[k]);
            changed[offset(k)] = static_cast<std::uint16_t>(changed[offset(k)] | bricks[k]);
        }
    }
    std::vector<LightChange> result;
    for (const auto& [pos, bricks] : changed) result.push_back({pos, bricks});
    return result;
}

namespace {

// Appends the changes of one column. `changes` are all in it, highest first.
void addColumn(const world::Chunk& chunk, std::span<const BlockChange> changes, const LightTable& table,
               std::vector<SourceChange>& result) {
    constexpr int kLayer = world::kChunkSize * world::kChunkSize;
    int dayBefore = kMaxLevel, dayAfter = kMaxLevel;
    auto next = changes.begin();
    const int column = next->index % kLayer;
    for (int z = world::kChunkHeight - 1; z >= 0; --z) {
        if (next == changes.end() && dayBefore == dayAfter) return;
        const auto index = static_cast<world::BlockIndex>(column + kLayer * z);
        const world::BlockId after = chunk.block(index);
        const bool isBlock = next != changes.end() && next->index == index;
        const world::BlockId before = isBlock ? (next++)->before : after;
        const int opacityBefore = levelOf(table.opacity(before), kDaylight);
        const int opacityAfter = levelOf(table.opacity(after), kDaylight);
        dayBefore = std::max(0, dayBefore - opacityBefore);
        dayAfter = std::max(0, dayAfter - opacityAfter);
        if (!isBlock && dayBefore == dayAfter) continue;
        result.push_back({.index = index,
                          .sourceBefore = withLevel(table.emission(before), kDaylight, dayBefore),
                          .sourceAfter = withLevel(table.emission(after), kDaylight, dayAfter),
                          .moreOpaque = opacityAfter > opacityBefore,
                          .isBlock = isBlock});
    }
}

}  // namespace

std::vector<SourceChange> findSourceChanges(const world::Chunk& chunk, std::span<const BlockChange> changes,
                                            const LightTable& table) {
    std::vector<BlockChange> sorted(changes.begin(), changes.end());
    const auto columnOf = [](const BlockChange& change) { return change.index & 255; };
    std::sort(sorted.begin(), sorted.end(), [&](const BlockChange& a, const BlockChange& b) {
        return columnOf(a) != columnOf(b) ? columnOf(a) < columnOf(b) : a.index > b.index;
    });
    std::vector<SourceChange> result;
    for (auto first = sorted.begin(); first != sorted.end();) {
        const auto last = std::find_if(first, sorted.end(), [&](const BlockChange& change) {
            return columnOf(change) != columnOf(*first);
        });
        addColumn(chunk, {first, last}, table, result);
        first = last;
    }
    return result;
}

}  // namespace terrane::light
