#include "terrane/store/derived_rows.h"

#include <algorithm>
#include <cassert>

#include "terrane/store/chunk_store.h"

namespace terrane::store {
namespace {

// Whether the highest set bit of b is above that of a.
constexpr bool isHigherBit(std::uint32_t a, std::uint32_t b) {
    return a < b && a < (a ^ b);
}

// Z-order: the chunks below a tile are contiguous, so most tiles are derived once.
bool isBeforeOnCurve(world::ChunkPos a, world::ChunkPos b) {
    const auto fromZero = [](std::int32_t c) { return static_cast<std::uint32_t>(c - world::kMinChunk); };
    const std::uint32_t dx = fromZero(a.x) ^ fromZero(b.x), dy = fromZero(a.y) ^ fromZero(b.y);
    return isHigherBit(dx, dy) ? a.y < b.y : a.x < b.x;
}

}  // namespace

base::Result<bool> ensureDerivedRows(ChunkStore& store, std::string_view rules) {
    if (store.metadata(kDerivedRowsMark) == rules) return false;
    TERRANE_TRY(store.deriveAll(rules));
    return true;
}

base::Result<void> deriveInGroups(const DerivedRows& rows, std::vector<world::ChunkPos> edited,
                                  const ReadEdited& saved, const WriteRows& write) {
    assert(rows.derive && "setDerivedRows() comes first");
    std::sort(edited.begin(), edited.end(), isBeforeOnCurve);
    for (auto next = edited.begin(); next != edited.end();) {
        std::vector<ChunkRow> group;
        for (; next != edited.end() && group.size() < kDeriveGroup; ++next)
            if (world::ChunkPtr chunk = saved(*next)) group.push_back({*next, std::move(chunk)});
        if (group.empty()) continue;
        TERRANE_TRY(write(rows.derive(group, saved)));
    }
    return {};
}

}  // namespace terrane::store
