#include "terrane/light/relight.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/light/kernels_internal.h"
#include "terrane/light/relight_internal.h"

namespace terrane::light {

namespace {

// The bricks that the changes can reach: in chunks firstX…lastX, firstY…lastY (0…2), bricks lowest…highest.
struct Range {
    int firstX = 1, lastX = 1, firstY = 1, lastY = 1, lowest = 0, highest = -1;

    bool contains(int chunk, int number) const {
        const int x = chunk % kFieldSide, y = chunk / kFieldSide;
        return x >= firstX && x <= lastX && y >= firstY && y <= lastY && number >= lowest &&
               number <= highest;
    }
};

Range rangeOf(std::span<const SourceChange> changes, world::Heights heights) {
    Range range;
    if (changes.empty()) return range;
    int lowest = heights.top, highest = heights.bottom;
    for (const SourceChange& change : changes) {
        const int x = change.index & 15, y = change.index >> 4 & 15, z = change.index >> 8;
        if (x < kMaxLevel) range.firstX = 0;
        if (x + kMaxLevel >= world::kChunkSize) range.lastX = 2;
        if (y < kMaxLevel) range.firstY = 0;
        if (y + kMaxLevel >= world::kChunkSize) range.lastY = 2;
        lowest = std::min(lowest, z);
        highest = std::max(highest, z);
    }
    range.lowest = heights.clamp(lowest - kMaxLevel) >> 4;
    range.highest = heights.clamp(highest + kMaxLevel) >> 4;
    return range;
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

LightValue brighterOf(LightValue a, LightValue b) {
    for (int c = 0; c < kComponentCount; ++c) a = withLevel(a, c, std::max(levelOf(a, c), levelOf(b, c)));
    return a;
}

// Sides of a brick, a bit each.
using Sides = unsigned;

// The sides that a voxel lies on.
Sides sidesOf(int voxel) {
    Sides sides = 0;
    for (const int axis : {0, 1, 2}) {
        const int at = voxel >> 4 * axis & 15;
        if (at == 0) sides |= 1u << 2 * axis;
        if (at == 15) sides |= 2u << 2 * axis;
    }
    return sides;
}

// Marks the rows with decreased levels and returns the sides on which they lie.
Sides markRows(const LightValue* decreased, int index, LightField& field) {
    Sides sides = 0;
    for (int row = 0; row < kRowsPerBrick; ++row) {
        std::array<std::uint64_t, 4> words;  // of four voxels
        std::memcpy(words.data(), decreased + 16 * row, sizeof(words));
        if ((words[0] | words[1] | words[2] | words[3]) == 0) continue;
        field.markRow(index, row);
        // Without its ends a row lies on no side in x.
        sides |= sidesOf(16 * row + 8);
        if (decreased[16 * row] != 0) sides |= 1u << kWest;
        if (decreased[16 * row + 15] != 0) sides |= 1u << kEast;
    }
    return sides;
}

// One change of the light of 3×3 chunks. Bricks are unpacked when light is first removed or raised in them.
// Until then they lie in the fields as dark ones beside those that change. This hides their light, which does
// not matter to a voxel beside them: it was raised to that light long ago, unless it is decreased or lets
// more light in than before. The bricks beside such voxels are unpacked too.
class Relighter {
  public:
    Relighter(LightWindow& window, std::span<const SourceChange> changes, const LightTable& table,
              LightScratch& scratch)
        : window_(window),
          changes_(changes),
          table_(table),
          decreases_(scratch.decreaseQueue),
          field_(scratch.field),
          range_(rangeOf(changes, window.chunks[kCenterChunk]->heights())) {
        decreases_.reset();
        field_.reset();
    }

    ChangedBricks run() {
        findDecreases();
        keepCertain();
        raiseSources();
        return store();
    }

  private:
    bool isInside(int chunk, int number) const {
        const auto c = static_cast<std::size_t>(chunk);
        return range_.contains(chunk, number) && window_.chunks[c] && window_.lights[c];
    }
    const LightBrick& lightBefore(int chunk, int number) const {
        return window_.lights[static_cast<std::size_t>(chunk)]->brick(number);
    }
    const world::Section& section(int chunk, int number) const {
        return window_.chunks[static_cast<std::size_t>(chunk)]->section(number);
    }

    static int findOrAdd(LightField& field, int chunk, int number) {
        const int found = field.find(chunk, number);
        return found != 0 ? found : field.add(chunk, number);
    }
    // Adds the bricks inside on all sides of one.
    void addBeside(LightField& field, int index) {
        const int chunk = field.brick(index).chunk, number = field.brick(index).number;
        const auto add = [&](int other, int otherNumber) {
            if (isInside(other, otherNumber)) findOrAdd(field, other, otherNumber);
        };
        if (chunk % kFieldSide > 0) add(chunk - 1, number);
        if (chunk % kFieldSide + 1 < kFieldSide) add(chunk + 1, number);
        if (chunk >= kFieldSide) add(chunk - kFieldSide, number);
        if (chunk + kFieldSide < kFieldChunks) add(chunk + kFieldSide, number);
        add(chunk, number - 1);
        add(chunk, number + 1);
    }

    // Prepares a brick of the decrease queue for decreases.
    void prepareDecrease(int index) {
        if (decreases_.brick(index).opacity) return;
        addBeside(decreases_, index);
        FieldBrick& brick = decreases_.brick(index);
        brick.opacity = opacityOf(section(brick.chunk, brick.number), table_, decreases_.pool()).values;
        brick.source = sourceOf(brick.chunk, brick.number);
        brick.before = decreases_.pool().unpack(lightBefore(brick.chunk, brick.number)).values;
    }
    // Sources of the changed world. Without daylight where the brick had none: no daylight is removed there.
    const LightValue* sourceOf(int chunk, int number) {
        const bool wasWithoutDaylight =
            lightBefore(chunk, number).surelyAll([](LightValue v) { return levelOf(v, kDaylight) == 0; });
        if (!wasWithoutDaylight) {
            const auto c = static_cast<std::size_t>(chunk);
            if (!sunlit_[c]) sunlit_[c] = findSunlitSources(*window_.chunks[c], table_, decreases_.pool());
            const auto found = std::partition_point(sunlit_[c]->begin(), sunlit_[c]->end(),
                                                    [&](const BrickRun& run) { return run.lowest > number; });
            if (found != sunlit_[c]->end()) return found->light.values;
        }
        return emissionOf(section(chunk, number), table_, decreases_.pool()).values;
    }

    void findDecreases() {
        for (const SourceChange& change : changes_) {
            const int number = world::sectionOf(change.index), voxel = world::indexInSection(change.index);
            const LightValue found = decreasedLevels(change, window_.lights[kCenterChunk]->at(change.index));
            if (found == 0) continue;
            const int index = findOrAdd(decreases_, kCenterChunk, number);
            prepareDecrease(index);
            decreases_.writable(decreases_.brick(index))[voxel] = found;
            decreases_.markAround(index, voxel);
        }
        for (int index = decreases_.popDirty(); index != 0; index = decreases_.popDirty()) {
            prepareDecrease(index);
            decreaseBrick(decreases_, index);
        }
    }

    // Unpacks the light that stays: the old light, or what keepCertain() has put into the place of decreases.
    void openLight(int index) {
        FieldBrick& brick = field_.brick(index);
        if (brick.before) return;
        const int decreased = decreases_.find(brick.chunk, brick.number);
        if (decreased != 0 && decreases_.brick(decreased).before) {
            const FieldBrick& from = decreases_.brick(decreased);
            LightValue* kept = from.light.writable;
            brick.before = from.before;
            brick.light = {kept ? kept : from.before, kept, false};
        } else {
            brick.light = field_.pool().unpack(lightBefore(brick.chunk, brick.number));
            brick.before = brick.light.values;
        }
    }
    // Prepares a brick of the field for raising.
    void prepareRaise(int index) {
        openLight(index);
        if (field_.brick(index).opacity) return;
        addBeside(field_, index);
        FieldBrick& brick = field_.brick(index);
        const int decreased = decreases_.find(brick.chunk, brick.number);
        const LightValue* known = decreased == 0 ? nullptr : decreases_.brick(decreased).opacity;
        brick.opacity =
            known ? known : opacityOf(section(brick.chunk, brick.number), table_, field_.pool()).values;
    }
    void openBeside(int index, Sides sides) {
        for (std::size_t side = 0; side < kSideCount; ++side) {
            const int beside = field_.brick(index).beside[side];
            if ((sides >> side & 1) != 0 && beside != 0) openLight(beside);
        }
    }

    // Replaces the decreased levels by the new sources.
    void keepCertain() {
        for (int k = 1; k < decreases_.brickCount(); ++k) {
            const FieldBrick& from = decreases_.brick(k);
            LightValue* decreased = from.light.writable;
            if (!decreased) continue;
            const int index = findOrAdd(field_, from.chunk, from.number);
            prepareRaise(index);
            const Sides sides = markRows(decreased, index, field_);
            replaceDecreased(decreased, from.source, from.before, decreased);
            openBeside(index, sides);
        }
    }

    void raiseSources() {
        for (const SourceChange& change : changes_) {
            const int number = world::sectionOf(change.index), voxel = world::indexInSection(change.index);
            const int found = field_.find(kCenterChunk, number);
            const bool isOpen = found != 0 && field_.brick(found).before;
            const LightValue before = isOpen ? field_.brick(found).light.values[voxel]
                                             : window_.lights[kCenterChunk]->at(change.index),
                             light = brighterOf(before, change.sourceAfter);
            if (light == before && !change.isBlock) continue;
            const int index = findOrAdd(field_, kCenterChunk, number);
            prepareRaise(index);
            if (light != before) {
                field_.writable(field_.brick(index))[voxel] = light;
                field_.markAround(index, voxel);
            } else {
                field_.markRow(index, voxel >> 4);
            }
            if (change.isBlock) openBeside(index, sidesOf(voxel));  // more light may enter than before
        }
        for (int index = field_.popDirty(); index != 0; index = field_.popDirty()) {
            prepareRaise(index);
            raiseBrick(field_, index);
        }
    }

    ChangedBricks store() {
        ChangedBricks changed{};
        std::array<std::shared_ptr<ChunkLight>, kFieldChunks> copies;
        for (int k = 1; k < field_.brickCount(); ++k) {
            const FieldBrick& brick = field_.brick(k);
            const LightValue* light = brick.light.values;
            if (!brick.before || light == brick.before ||
                std::memcmp(light, brick.before, sizeof(Brick)) == 0)
                continue;
            const auto c = static_cast<std::size_t>(brick.chunk);
            if (!copies[c]) copies[c] = std::make_shared<ChunkLight>(*window_.lights[c]);
            copies[c]->setBrick(brick.number, packBrick({light, nullptr, false}));
            changed[c].add(brick.number);
        }
        for (std::size_t c = 0; c < copies.size(); ++c) {
            if (copies[c]) window_.lights[c] = std::move(copies[c]);
        }
        return changed;
    }

    LightWindow& window_;
    std::span<const SourceChange> changes_;
    const LightTable& table_;
    LightField &decreases_, &field_;
    Range range_;
    // By chunk: sources of the bricks that daylight enters from above, once they are needed.
    std::array<std::optional<ChunkBricks>, kFieldChunks> sunlit_;
};

}  // namespace

ChangedBricks relight(LightWindow& window, std::span<const BlockChange> changes, const LightTable& table,
                      LightScratch& scratch) {
    TERRANE_ZONE("relight");
    base::require(window.chunks[kCenterChunk] && window.lights[kCenterChunk],
                  "relight: the changed chunk, in the middle, or its light is null");
    const std::vector<SourceChange> sources = findSourceChanges(*window.chunks[kCenterChunk], changes, table);
    return Relighter(window, sources, table, scratch).run();
}

std::vector<LightChange> relight(LitChunks& chunks, std::span<const world::BlockEdit> edits,
                                 const LightTable& table, LightScratch& scratch) {
    std::map<world::ChunkPos, std::vector<BlockChange>> byChunk;
    for (const world::BlockEdit& edit : edits)
        byChunk[world::chunkOf(edit.pos)].push_back({world::blockIndex(edit.pos), edit.before});

    std::map<world::ChunkPos, world::SectionSet> changed;
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
            if (bricks[k].isEmpty()) continue;
            around[k]->light = std::move(window.lights[k]);
            changed[offset(k)] |= bricks[k];
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
    const world::Heights heights = chunk.heights();
    int dayBefore = kMaxLevel, dayAfter = kMaxLevel;
    auto next = changes.begin();
    const int column = next->index & (world::kBlocksPerLayer - 1);
    for (int z = heights.top - 1; z >= heights.bottom; --z) {
        // The world below the changes is as it was, and so is the dark down to the next of them.
        if (dayBefore == dayAfter) {
            if (next == changes.end()) return;
            if (dayAfter == 0) z = next->index >> 8;
        }
        // Clear sections above the next change let daylight through.
        const world::Section& section = chunk.section(z >> 4);
        if (dayBefore == dayAfter && section.isUniform() && z >> 4 > next->index >> 12 &&
            table.opacity(section.uniformValue()) == allComponents(0)) {
            z &= ~(world::kSectionSize - 1);
            continue;
        }
        const world::BlockIndex index = column + world::kBlocksPerLayer * z;
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
    const auto columnOf = [](const BlockChange& change) {
        return change.index & (world::kBlocksPerLayer - 1);
    };
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
