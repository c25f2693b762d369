#include "tests/base/failing_memory.h"

#include <atomic>
#include <cstdlib>
#include <new>

#ifdef _WIN32  // functions of its own for aligned memory
#include <malloc.h>
#endif

namespace {

std::atomic<bool> isFailing = false, failed = false;
std::atomic<long> counted = 0, failFrom = 0, failUntil = 0;

bool fails() {
    if (!isFailing || terrane::base::detail::enoughMemory > 0) return false;
    const long number = counted++;
    if (number < failFrom || number >= failUntil) return false;
    failed = true;
    return true;
}

[[maybe_unused]] void* allocate(std::size_t bytes) {
    if (fails()) throw std::bad_alloc();
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
    throw std::bad_alloc();
}

#ifdef _WIN32
void* alignedMemory(std::size_t step, std::size_t bytes) {
    return _aligned_malloc(bytes, step);
}
void freeAligned(void* memory) {
    _aligned_free(memory);
}
#else
[[maybe_unused]] void* alignedMemory(std::size_t step, std::size_t bytes) {
    return std::aligned_alloc(step, (bytes + step) / step * step);
}
[[maybe_unused]] void freeAligned(void* memory) {
    std::free(memory);
}
#endif

[[maybe_unused]] void* allocateAligned(std::size_t bytes, std::align_val_t alignment) {
    const auto step = static_cast<std::size_t>(alignment);
    if (fails()) throw std::bad_alloc();
    if (void* memory = alignedMemory(step, bytes)) return memory;
    throw std::bad_alloc();
}

}  // namespace

// The thread sanitizer has its own operator new, which cannot be replaced.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TERRANE_MEMORY_NEVER_FAILS
#endif
#endif
#ifndef TERRANE_MEMORY_NEVER_FAILS
void* operator new(std::size_t bytes) {
    return allocate(bytes);
}
void* operator new[](std::size_t bytes) {
    return allocate(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return allocateAligned(bytes, alignment);
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return allocateAligned(bytes, alignment);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    return fails() ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
    return fails() ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    freeAligned(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
    freeAligned(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    freeAligned(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    freeAligned(memory);
}
#endif

namespace terrane::base {

FailingMemory::FailingMemory(long after, long count) {
    counted = 0;
    failFrom = after;
    failUntil = count > LONG_MAX - after ? LONG_MAX : after + count;
    failed = false;
    isFailing = true;
}

FailingMemory::~FailingMemory() {
    isFailing = false;
}

bool FailingMemory::isPossible() {
    const FailingMemory memory(0);
    try {
        ::operator delete(::operator new(1));
    } catch (const std::bad_alloc&) {
    }
    return failed;
}

bool FailingMemory::hasFailed() {
    return failed;
}

long FailingMemory::allocations() {
    return counted;
}

bool FailingMemory::failsNext() {
    return fails();
}

}  // namespace terrane::base
