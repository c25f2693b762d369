// Makes allocations of the whole program fail. The test program links failing_memory.cpp, which replaces
// operator new.
#pragma once

#include <climits>

namespace terrane::base {

// While an object exists, allocations by any thread fail: `count` of them, after `after` successful ones.
class FailingMemory {
  public:
    explicit FailingMemory(long after, long count = LONG_MAX);
    ~FailingMemory();
    FailingMemory(const FailingMemory&) = delete;
    FailingMemory& operator=(const FailingMemory&) = delete;

    static bool isPossible();   // not under the thread sanitizer
    static bool hasFailed();    // an allocation, since the last one began
    static long allocations();  // since then
    static bool failsNext();    // counts one more, for allocators besides operator new
};

namespace detail {
inline thread_local int enoughMemory = 0;
}

// While an object exists, allocations of this thread succeed and are not counted: those of the test itself.
class EnoughMemory {
  public:
    EnoughMemory() { ++detail::enoughMemory; }
    ~EnoughMemory() { --detail::enoughMemory; }
    EnoughMemory(const EnoughMemory&) = delete;
    EnoughMemory& operator=(const EnoughMemory&) = delete;
};

}  // namespace terrane::base
