#include "terrane/gpu/arena_allocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace terrane::gpu {
namespace {

TEST(RangeAllocatorTest, takesTheSmallestRangeThatFits) {
    RangeAllocator ranges(100);
    ASSERT_EQ(ranges.allocate(10), 0U);
    ASSERT_EQ(ranges.allocate(20), 10U);
    ASSERT_EQ(ranges.allocate(30), 30U);
    ASSERT_EQ(ranges.allocate(40), 60U);
    EXPECT_EQ(ranges.freeTotal(), 0U);
    EXPECT_EQ(ranges.allocate(1), std::nullopt);
    ranges.free(0, 10);
    ranges.free(30, 30);
    EXPECT_EQ(ranges.largestFree(), 30U);
    EXPECT_EQ(ranges.allocate(9), 0U);
    EXPECT_EQ(ranges.allocate(11), 30U);
}

TEST(RangeAllocatorTest, mergesFreedNeighbors) {
    RangeAllocator ranges(30);
    for (std::uint32_t i = 0; i < 3; ++i) ASSERT_EQ(ranges.allocate(10), i * 10);
    ranges.free(0, 10);
    ranges.free(20, 10);
    EXPECT_EQ(ranges.largestFree(), 10U);
    ranges.free(10, 10);
    EXPECT_EQ(ranges.largestFree(), 30U);
    EXPECT_EQ(ranges.allocate(30), 0U);
}

TEST(RangeAllocatorTest, growsByFreeRoomAtTheEnd) {
    RangeAllocator ranges(0);
    EXPECT_EQ(ranges.allocate(1), std::nullopt);
    EXPECT_EQ(ranges.largestFree(), 0U);
    ranges.grow(8);
    ASSERT_EQ(ranges.allocate(6), 0U);
    ranges.grow(16);
    EXPECT_EQ(ranges.capacity(), 16U);
    EXPECT_EQ(ranges.largestFree(), 10U);
    EXPECT_EQ(ranges.allocate(10), 6U);
}

TEST(RangeAllocatorTest, reachesTheLastUnitOf32Bits) {
    RangeAllocator ranges(0xFFFFFFFFU);
    ASSERT_EQ(ranges.allocate(0xFFFFFFFEU), 0U);
    ASSERT_EQ(ranges.allocate(1), 0xFFFFFFFEU);
    ranges.free(0, 0xFFFFFFFEU);
    ranges.free(0xFFFFFFFEU, 1);
    EXPECT_EQ(ranges.largestFree(), 0xFFFFFFFFU);
}

// Reference: one flag per unit.
class UnitMap {
  public:
    explicit UnitMap(std::size_t capacity) : used_(capacity, false) {}

    void mark(std::uint32_t offset, std::uint32_t size, bool used) {
        ASSERT_LE(offset + size, used_.size());
        for (std::uint32_t i = offset; i < offset + size; ++i) {
            ASSERT_NE(used_[i], used) << "unit " << i;
            used_[i] = used;
        }
    }
    void grow(std::size_t capacity) { used_.resize(capacity, false); }

    [[nodiscard]] std::size_t freeTotal() const {
        return static_cast<std::size_t>(std::count(used_.begin(), used_.end(), false));
    }
    // Length of the shortest free run of at least `size`, 0 if there is none, and of the longest.
    [[nodiscard]] std::pair<std::size_t, std::size_t> freeRuns(std::size_t size) const {
        std::size_t shortest = 0;
        std::size_t longest = 0;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            std::size_t run = 0;
            while (i < used_.size() && !used_[i]) ++run, ++i;
            if (run >= size && run > 0 && (shortest == 0 || run < shortest)) shortest = run;
            longest = std::max(longest, run);
        }
        return {shortest, longest};
    }
    [[nodiscard]] std::size_t runAt(std::size_t offset) const {
        std::size_t run = 0;
        while (offset + run < used_.size() && !used_[offset + run]) ++run;
        return run;
    }

  private:
    std::vector<bool> used_;
};

struct Range {
    std::uint32_t offset;
    std::uint32_t size;
};

class RandomUse {
  public:
    explicit RandomUse(std::uint32_t seed) : random_(seed) {}

    void step() {
        const std::uint32_t choice = random_() % 100;
        if (choice == 0) {
            const std::uint32_t capacity = ranges_.capacity() + random_() % 64;
            ranges_.grow(capacity);
            map_.grow(capacity);
        } else if (choice < 52 || live_.empty()) {
            allocate(1 + random_() % 40);
        } else {
            freeOne();
        }
        ASSERT_EQ(ranges_.freeTotal(), map_.freeTotal());
        ASSERT_EQ(ranges_.largestFree(), map_.freeRuns(1).second);
    }

  private:
    void allocate(std::uint32_t size) {
        const std::size_t best = map_.freeRuns(size).first;
        const std::optional<std::uint32_t> offset = ranges_.allocate(size);
        ASSERT_EQ(offset.has_value(), best > 0);
        if (!offset) return;
        ASSERT_EQ(map_.runAt(*offset), best) << "not the best fit";
        map_.mark(*offset, size, true);
        live_.push_back({*offset, size});
    }

    void freeOne() {
        std::swap(live_[random_() % live_.size()], live_.back());
        const Range range = live_.back();
        live_.pop_back();
        map_.mark(range.offset, range.size, false);
        ranges_.free(range.offset, range.size);
    }

    static constexpr std::uint32_t kStart = 500;
    std::mt19937 random_;
    RangeAllocator ranges_{kStart};
    UnitMap map_{kStart};
    std::vector<Range> live_;
};

TEST(RangeAllocatorTest, agreesWithAMapOfUnitsUnderRandomUse) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        RandomUse use(seed);
        for (int step = 0; step < 1000; ++step) {
            use.step();
            if (HasFatalFailure()) FAIL() << "seed " << seed << ", step " << step;
        }
    }
}

// Meshes of 200 to 3,200 quads are added and removed, as on a flight through a landscape, in a pool that
// stays 90 % full.
TEST(RangeAllocatorTest, fragmentsLittleUnderMeshesThatComeAndGo) {
    constexpr std::uint32_t kCapacity = 4'000'000, kFull = kCapacity / 10 * 9;
    RangeAllocator ranges(kCapacity);
    std::mt19937 random(7);
    std::vector<Range> live;
    std::uint32_t used = 0, failures = 0;
    for (int step = 0; step < 100'000; ++step) {
        const std::uint32_t size = 200 + random() % 3000;
        while (used + size > kFull) {
            std::swap(live[random() % live.size()], live.back());
            ranges.free(live.back().offset, live.back().size);
            used -= live.back().size;
            live.pop_back();
        }
        const std::optional<std::uint32_t> offset = ranges.allocate(size);
        if (!offset) {
            ++failures;
            continue;
        }
        live.push_back({*offset, size});
        used += size;
    }
    EXPECT_EQ(failures, 0u);
    const double fragmentation = 1.0 - static_cast<double>(ranges.largestFree()) / ranges.freeTotal();
    RecordProperty("fragmentation_percent", static_cast<int>(100 * fragmentation));
    EXPECT_EQ(ranges.freeTotal(), kCapacity - used);
    EXPECT_GE(ranges.largestFree(), 3200u) << "the next mesh still fits";
    for (const Range& range : live) ranges.free(range.offset, range.size);
    EXPECT_EQ(ranges.largestFree(), kCapacity) << "all is one again";
}

}  // namespace
}  // namespace terrane::gpu
