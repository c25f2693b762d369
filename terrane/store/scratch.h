// Per-thread scratch memory for uncompressed chunks.
#pragma once

#include "terrane/store/bytes.h"

namespace terrane::store {

// A thread frees scratch memory beyond this. Sections take 9 KB on average, 0.5 MiB at most.
constexpr std::size_t kKeptBytes = 1u << 20;

// The calling thread's scratch memory, empty. At most one per thread at a time.
class Scratch {
  public:
    Scratch() { memory().clear(); }
    ~Scratch() {
        if (memory().capacity() > kKeptBytes) Bytes().swap(memory());
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    Bytes& bytes() { return memory(); }

  private:
    static Bytes& memory() {
        thread_local Bytes bytes;
        return bytes;
    }
};

}  // namespace terrane::store
