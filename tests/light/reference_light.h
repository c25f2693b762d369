// The formula of docs/light.md, applied to every voxel of an area until nothing changes: slow and obvious. A
// border of darkness that lets nothing through stands around the area.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/light/test_area.h"

namespace terrane::light {

class Reference {
  public:
    // Levels are found below `height`; from there on must be nothing but air.
    Reference(const TestArea& area, int height) : area_(area), height_(height), row_(area.width() + 2) {
        for (int z = area.heights.bottom - 1; z <= height; ++z) {
            for (int y = -1; y <= area.height(); ++y) {
                for (int x = -1; x <= area.width(); ++x) addVoxel(x, y, z);
            }
        }
    }

    // Index as in TestArea.
    std::vector<int> solve(int component) {
        setSources(component);
        while (raiseAll()) continue;
        std::vector<int> result;
        for (const int at : inside_) result.push_back(level_[static_cast<std::size_t>(at)]);
        return result;
    }

  private:
    void addVoxel(int x, int y, int z) {
        const bool isInside = x >= 0 && y >= 0 && z >= area_.heights.bottom && x < area_.width() &&
                              y < area_.height() && z < height_;
        if (isInside) inside_.push_back(static_cast<int>(types_.size()));
        types_.push_back(isInside ? &area_.type(x, y, z) : nullptr);
    }

    int layer() const { return row_ * (area_.height() + 2); }

    // From above, so that daylight is what the block above lets through.
    void setSources(int component) {
        level_.assign(types_.size(), 0);
        for (auto next = inside_.rbegin(); next != inside_.rend(); ++next) {
            const auto at = static_cast<std::size_t>(*next), above = at + static_cast<std::size_t>(layer());
            const world::BlockType& type = *types_[at];
            const int daylight = types_[above] ? level_[above] : kMaxLevel;
            level_[at] = component == kDaylight ? std::max(0, daylight - type.opacity)
                                                : type.emission[static_cast<std::size_t>(component)];
        }
    }

    bool raiseAll() {
        bool changed = false;
        int* const level = level_.data();
        for (const int at : inside_) {
            const int loss = 1 + types_[static_cast<std::size_t>(at)]->opacity;
            for (const int step : {1, row_, layer()}) {
                const int brighter = std::max(level[at - step], level[at + step]);
                if (brighter - loss <= level[at]) continue;
                level[at] = brighter - loss;
                changed = true;
            }
        }
        return changed;
    }

    const TestArea& area_;
    int height_, row_;
    std::vector<const world::BlockType*> types_;  // with the border, where they are null
    std::vector<int> inside_;                     // indices of the others
    std::vector<int> level_;
};

// Compares the light of a world whose blocks end at kFilledHeight, or at `height`: no color reaches further.
inline void expectReference(const TestArea& area, const std::vector<LightValue>& light,
                            int height = kFilledHeight + 16) {
    ASSERT_EQ(light.size(), area.index(0, 0, area.heights.top));
    Reference reference(area, height);
    for (int c = 0; c < kComponentCount; ++c) {
        const std::vector<int> expected = reference.solve(c);
        for (std::size_t at = 0; at < expected.size(); ++at) {
            ASSERT_EQ(levelOf(light[at], c), expected[at]) << "component " << c << " at index " << at;
        }
    }
    for (std::size_t at = area.index(0, 0, height); at < light.size(); ++at) {
        ASSERT_EQ(light[at], kFullDaylight);
    }
}

}  // namespace terrane::light
