// Allocates ranges of several buffers (arenas) of limited size. A range lies in one arena. Units are the
// caller's (quads). Plain bookkeeping without OpenGL: the caller creates the buffers of a growth. It is not
// synchronized: one thread at a time may use it.
//
// An address is arena × arenaSize + offset, so that 32 bits name a unit in any arena. Only the last arena
// grows: it doubles, which copies it, up to the limit. When it cannot grow further, or there is no room for
// the copy, another arena is added without a copy.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "terrane/gpu/buffer.h"

namespace terrane::gpu {

// Allocates ranges of one large buffer by best fit, and merges neighbors when they are freed. Units are the
// caller's (bytes, quads). It uses no OpenGL and is not synchronized: one thread at a time may use it.
class RangeAllocator {
  public:
    explicit RangeAllocator(std::uint32_t capacity);

    // Allocates from the smallest free range that holds size, the lowest of those: O(log n). Returns nothing
    // if there is no such range.
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

struct ArenaSizes {
    std::uint32_t arena = 0;  // most units of an arena
    std::uint32_t first = 0;  // units with which an arena begins; at most `arena`
    std::uint32_t count = 1;  // most arenas
};

// The arena grows to `capacity` units. If it existed before, its contents must be copied.
struct ArenaGrowth {
    std::uint32_t arena = 0, capacity = 0;
};

class ArenaAllocator {
  public:
    // Begins with one arena. Addresses of all arenas must fit 32 bits.
    explicit ArenaAllocator(const ArenaSizes& sizes);

    // Allocates from the first arena with a free range of at least `size`, by best fit there. Returns nothing
    // if no arena has one.
    [[nodiscard]] std::optional<std::uint32_t> allocate(std::uint32_t size);
    // Frees a range from allocate, or a part of one.
    void free(std::uint32_t address, std::uint32_t size);

    // Returns the growth after which `size` units fit, if there is one that adds at most `room` units. While
    // an arena is copied the old buffer exists beside the new one, so all of the new capacity counts as
    // added.
    [[nodiscard]] std::optional<ArenaGrowth> planGrowth(std::uint32_t size, std::uint64_t room) const;
    // Applies a planned growth. The new units are free.
    void grow(const ArenaGrowth& growth);

    [[nodiscard]] std::uint32_t arenaSize() const { return sizes_.arena; }
    [[nodiscard]] std::uint32_t arenaOf(std::uint32_t address) const { return address / sizes_.arena; }
    [[nodiscard]] std::uint32_t offsetOf(std::uint32_t address) const { return address % sizes_.arena; }
    [[nodiscard]] const std::vector<RangeAllocator>& arenas() const { return arenas_; }
    [[nodiscard]] std::uint64_t capacity() const;  // of all arenas
    [[nodiscard]] std::uint64_t freeTotal() const;

  private:
    ArenaSizes sizes_;
    std::vector<RangeAllocator> arenas_;
};

// The buffers of an ArenaAllocator's arenas, for code that writes to addresses in them. It is a plain value.
// Address a lies in buffers[a / arenaSize], at unit a % arenaSize.
struct ArenaBuffers {
    std::vector<const Buffer*> buffers;  // one at least; they outlive this
    std::uint32_t arenaSize = UINT32_MAX;
};

}  // namespace terrane::gpu
