#include "terrane/gpu/range_allocator.h"

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

}  // namespace terrane::gpu
