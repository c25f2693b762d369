#include "terrane/render/figures/figure_shadows.h"

#include <algorithm>
#include <glm/common.hpp>

#include "terrane/render/figures/figure_pass.h"

namespace terrane::render {
namespace {

constexpr int kRowSlots = static_cast<int>(shared::kShadowTiles);

std::size_t numberOf(glm::ivec2 slot) {
    return static_cast<std::size_t>(slot.x + kRowSlots * slot.y);
}

struct TouchedTiles {
    std::array<bool, kShadowSlots> slots{};
    glm::ivec2 min{1 << 30}, max{-(1 << 30)};  // places

    bool areNone() const { return max.x < min.x; }
};

TouchedTiles touchedBy(const NearestShadowMap& map, std::span<const glm::dvec3> feet) {
    TouchedTiles touched;
    const double blocks = shadowTileBlocks(0);
    for (const glm::dvec3& place : feet) {
        const PlaneBox box =
            onPlane(map.plane, place + glm::dvec3(kFigureLow), place + glm::dvec3(kFigureHigh));
        const glm::ivec2 low(glm::floor(box.min / blocks)), high(glm::floor(box.max / blocks));
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                const std::size_t slot = numberOf(glm::ivec2(x, y) & (kRowSlots - 1));
                if (map.tiles[slot].place != glm::ivec2(x, y)) continue;  // not drawn yet
                touched.slots[slot] = true;
                touched.min = glm::min(touched.min, glm::ivec2(x, y));
                touched.max = glm::max(touched.max, glm::ivec2(x, y));
            }
        }
    }
    return touched;
}

// Splits the tiles from `min` to `max` into rectangles that are contiguous in the map, at most four.
std::vector<ShadowTiles> rectanglesOf(const NearestShadowMap& map, glm::ivec2 min, glm::ivec2 max) {
    const auto endOf = [](int from, int last) { return std::min(last, from | (kRowSlots - 1)); };
    std::vector<ShadowTiles> rectangles;
    for (int y = min.y; y <= max.y; y = endOf(y, max.y) + 1)
        for (int x = min.x; x <= max.x; x = endOf(x, max.x) + 1)
            rectangles.push_back(
                {map.plane, 0, map.layer, {x, y}, {endOf(x, max.x) - x + 1, endOf(y, max.y) - y + 1}});
    return rectangles;
}

}  // namespace

FigureShadowPlan FigureShadows::plan(const NearestShadowMap& map, std::span<const glm::dvec3> feet) {
    const TouchedTiles touched = touchedBy(map, feet);
    if (touched.areNone()) return {};
    FigureShadowPlan plan;
    for (int y = 0; y < kRowSlots; ++y) {
        for (int x = 0; x < kRowSlots; ++x) {
            const std::size_t slot = numberOf({x, y});
            const std::uint64_t drawn = map.tiles[slot].drawn;
            Copied& copied = copied_[slot];
            const bool isCopied = copied.layer == map.layer && copied.drawn == drawn && !copied.hasFigures;
            if (drawn > 0 && (!isCopied || touched.slots[slot])) {
                if (!isCopied) plan.copies.push_back({x, y});
                copied = {map.layer, drawn, touched.slots[slot]};
            }
        }
    }
    plan.draws = rectanglesOf(map, touched.min, touched.max);
    return plan;
}

}  // namespace terrane::render
