#include "terrane/gpu/arena_allocator.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace terrane::gpu {

RangeAllocator::RangeAllocator(std::uint32_t capacity) {
    grow(capacity);
}

std::optional<std::uint32_t> RangeAllocator::allocate(std::uint32_t size) {
    assert(size > 0 && "an empty range has no place");
    const auto fit = bySize_.lower_bound({size, 0});
    if (fit == bySize_.end()) return std::nullopt;
    const auto [rangeSize, offset] = *fit;
    removeFree(byOffset_.find(offset));
    if (rangeSize > size) addFree(offset + size, rangeSize - size);
    freeTotal_ -= size;
    return offset;
}

void RangeAllocator::free(std::uint32_t offset, std::uint32_t size) {
    assert(size > 0 && "an empty range was never allocated");
    assert(offset <= capacity_ && size <= capacity_ - offset && "the range lies in the buffer");
    freeTotal_ += size;
    const auto next = byOffset_.lower_bound(offset);
    if (next != byOffset_.begin()) {
        const auto before = std::prev(next);
        assert(before->first + before->second <= offset && "a range is freed once");
        if (before->first + before->second == offset) {
            offset = before->first;
            size += before->second;
            removeFree(before);
        }
    }
    if (next != byOffset_.end()) {
        assert(offset + size <= next->first && "a range is freed once");
        if (offset + size == next->first) {
            size += next->second;
            removeFree(next);
        }
    }
    addFree(offset, size);
}

void RangeAllocator::grow(std::uint32_t newCapacity) {
    assert(newCapacity >= capacity_ && "ranges in use are not taken away");
    const std::uint32_t added = newCapacity - capacity_;
    const std::uint32_t oldCapacity = capacity_;
    capacity_ = newCapacity;
    if (added > 0) free(oldCapacity, added);
}

std::uint32_t RangeAllocator::largestFree() const {
    return bySize_.empty() ? 0 : bySize_.rbegin()->first;
}

void RangeAllocator::addFree(std::uint32_t offset, std::uint32_t size) {
    byOffset_.emplace(offset, size);
    bySize_.emplace(size, offset);
}

void RangeAllocator::removeFree(ByOffset::iterator range) {
    bySize_.erase({range->second, range->first});
    byOffset_.erase(range);
}

ArenaAllocator::ArenaAllocator(const ArenaSizes& sizes) : sizes_(sizes) {
    assert(sizes.arena > 0 && sizes.first > 0 && sizes.first <= sizes.arena && "arenas have units");
    assert(sizes.count > 0 && std::uint64_t{sizes.count} * sizes.arena <= std::uint64_t{1} << 32 &&
           "addresses fit 32 bits");
    arenas_.emplace_back(sizes.first);
}

std::optional<std::uint32_t> ArenaAllocator::allocate(std::uint32_t size) {
    for (std::uint32_t k = 0; k < arenas_.size(); ++k) {
        if (const auto offset = arenas_[k].allocate(size)) return k * sizes_.arena + *offset;
    }
    return std::nullopt;
}

void ArenaAllocator::free(std::uint32_t address, std::uint32_t size) {
    assert(arenaOf(address) < arenas_.size() && "the range was allocated");
    arenas_[arenaOf(address)].free(offsetOf(address), size);
}

std::optional<ArenaGrowth> ArenaAllocator::planGrowth(std::uint32_t size, std::uint64_t room) const {
    const auto last = static_cast<std::uint32_t>(arenas_.size() - 1);
    const std::uint64_t old = arenas_[last].capacity();
    const std::uint64_t doubled =
        std::min<std::uint64_t>(old + std::max<std::uint64_t>(old, size), sizes_.arena);
    if (doubled >= old + size && doubled <= room)
        return ArenaGrowth{last, static_cast<std::uint32_t>(doubled)};
    if (size > sizes_.arena || size > room || arenas_.size() == sizes_.count) return std::nullopt;
    const std::uint64_t capacity = std::min<std::uint64_t>(std::max(sizes_.first, size), room);
    return ArenaGrowth{last + 1, static_cast<std::uint32_t>(capacity)};
}

void ArenaAllocator::grow(const ArenaGrowth& growth) {
    assert(growth.capacity <= sizes_.arena && growth.arena < sizes_.count && "as planned");
    if (growth.arena == arenas_.size()) {
        arenas_.emplace_back(growth.capacity);
    } else {
        arenas_[growth.arena].grow(growth.capacity);
    }
}

std::uint64_t ArenaAllocator::capacity() const {
    std::uint64_t sum = 0;
    for (const RangeAllocator& arena : arenas_) sum += arena.capacity();
    return sum;
}

std::uint64_t ArenaAllocator::freeTotal() const {
    std::uint64_t sum = 0;
    for (const RangeAllocator& arena : arenas_) sum += arena.freeTotal();
    return sum;
}

}  // namespace terrane::gpu
