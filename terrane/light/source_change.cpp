#include "terrane/light/source_change_internal.h"

#include <algorithm>
#include <functional>

namespace terrane::light {
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
