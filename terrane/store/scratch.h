// A thread's memory for a chunk before compression, kept from one chunk to the next.
#pragma once

#include "terrane/store/bytes.h"

namespace terrane::store {

// Beyond this a thread's memory for uncompressed chunks is given back. Sections take 9 KB on average, 0.5 MiB
// at most.
constexpr std::size_t kKeptBytes = 1u << 20;

// One thread's memory for a chunk before compression, empty. Of one such at a time.
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
