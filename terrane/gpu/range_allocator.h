// Allocates ranges of one large buffer: best fit, neighbors merged when freed. Units are the caller's (bytes,
// quads). Plain bookkeeping without OpenGL; not synchronized: one thread at a time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace terrane::gpu {

class RangeAllocator {
  public:
    explicit RangeAllocator(std::uint32_t capacity);

    // Allocates from the smallest free range that holds size, the lowest of those: O(log n). None if there is
    // no such range.
    [[nodiscard]] std::optional<std::uint32_t> allocate(std::uint32_t size);
    // Frees a range from allocate, or a part of one; the rest is freed later. O(log n).
    void free(std::uint32_t offset, std::uint32_t size);
    // Adds room at the end, which is free.
    void grow(std::uint32_t newCapacity);

    [[nodiscard]] std::uint32_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint32_t freeTotal() const { return freeTotal_; }
    [[nodiscard]] std::uint32_t largestFree() const;

  private:
    using ByOffset = std::map<std::uint32_t, std::uint32_t>;

    void addFree(std::uint32_t offset, std::uint32_t size);
    void removeFree(ByOffset::iterator range);

    ByOffset byOffset_;                                         // free ranges: offset, size
    std::set<std::pair<std::uint32_t, std::uint32_t>> bySize_;  // the same: size, offset
    std::uint32_t capacity_ = 0;
    std::uint32_t freeTotal_ = 0;
};

}  // namespace terrane::gpu
