// The heights of a world: its lowest layer and the layer above its highest one. They are part of a world's
// identity, like its seed and its generator. A chunk has the heights of its world at every level.
#pragma once

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>

#include "terrane/base/result.h"
#include "terrane/shared/constants.h"

namespace terrane::world {

constexpr int kLowestBottom = -2048, kHighestTop = 2048;
constexpr int kMostLayers = kHighestTop - kLowestBottom;
constexpr int kSectionSize = static_cast<int>(shared::kSectionSize);
constexpr int kLowestSection = kLowestBottom / kSectionSize;
constexpr int kMostSections = kMostLayers / kSectionSize;

// Layers bottom … top − 1. Both are multiples of 16. A section's number is that of its lowest layer, divided
// by 16: −128 … 127.
struct Heights {
    int bottom = 0;
    int top = static_cast<int>(shared::kChunkHeight);

    constexpr int layers() const { return top - bottom; }
    constexpr int sections() const { return layers() / kSectionSize; }
    constexpr int firstSection() const { return bottom / kSectionSize; }
    constexpr int endSection() const { return top / kSectionSize; }  // the number after the highest one
    constexpr bool contains(int z) const { return z >= bottom && z < top; }
    constexpr int clamp(int z) const { return std::clamp(z, bottom, top - 1); }

    bool operator==(const Heights&) const = default;
};

// Heights that somebody asks for; those without a value are taken from elsewhere.
struct RequestedHeights {
    std::optional<int> bottom, top;

    constexpr RequestedHeights() = default;
    constexpr RequestedHeights(std::optional<int> lowest, std::optional<int> above)
        : bottom(lowest), top(above) {}
    constexpr RequestedHeights(Heights heights) : bottom(heights.bottom), top(heights.top) {}

    constexpr Heights over(Heights otherwise) const {
        return {bottom.value_or(otherwise.bottom), top.value_or(otherwise.top)};
    }
};

constexpr bool isValid(Heights heights) {
    const auto isBorder = [](int z) {
        return z % kSectionSize == 0 && z >= kLowestBottom && z <= kHighestTop;
    };
    return isBorder(heights.bottom) && isBorder(heights.top) && heights.bottom < heights.top;
}

// Fails with the rule unless the heights are valid.
[[nodiscard]] base::Result<void> checkHeights(Heights heights);

// "0 to 255": the lowest and the highest layer.
std::string describe(Heights heights);

// Sections of a column, by number.
class SectionSet {
  public:
    // Returns all sections of these heights.
    static SectionSet all(Heights heights) {
        SectionSet set;
        for (int number = heights.firstSection(); number < heights.endSection(); ++number) set.add(number);
        return set;
    }

    void add(int number) { bits_.set(indexOf(number)); }
    bool has(int number) const { return bits_[indexOf(number)]; }
    bool isEmpty() const { return bits_.none(); }
    std::size_t count() const { return bits_.count(); }
    SectionSet& operator|=(const SectionSet& other) {
        bits_ |= other.bits_;
        return *this;
    }
    bool operator==(const SectionSet&) const = default;

    // Calls use(number) for each section, from below.
    template <class Use>
    void forEach(Use use) const {
        if (bits_.none()) return;
        for (int number = kLowestSection; number < kLowestSection + kMostSections; ++number)
            if (has(number)) use(number);
    }

  private:
    static std::size_t indexOf(int number) { return static_cast<std::size_t>(number - kLowestSection); }
    std::bitset<kMostSections> bits_;
};

}  // namespace terrane::world
