// Little-endian numbers in byte strings, as saved. Reading is bounds-checked: past the end it returns zeros
// and sets a flag, so that a reader needs one check per part.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::store {

static_assert(std::endian::native == std::endian::little, "numbers are copied in memory order");

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

inline void append(Bytes& bytes, ByteView more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
}

template <class T>
void appendNumber(Bytes& bytes, T value) {
    static_assert(std::is_integral_v<T>);
    append(bytes, std::as_bytes(std::span(&value, 1)));
}

class ByteReader {
  public:
    explicit ByteReader(ByteView bytes) : rest_(bytes) {}

    template <class T>
    T number() {
        static_assert(std::is_integral_v<T>);
        T value = 0;
        copyTo(std::as_writable_bytes(std::span(&value, 1)));
        return value;
    }

    // Fills `target`, or leaves it unchanged if fewer bytes are left.
    void copyTo(std::span<std::byte> target) {
        const ByteView part = take(target.size());
        if (!part.empty()) std::memcpy(target.data(), part.data(), part.size());
    }

    // Reads the next `count` bytes, or none if fewer are left.
    ByteView take(std::size_t count) {
        if (count > rest_.size()) {
            isPastEnd_ = true;
            rest_ = {};
            return {};
        }
        const ByteView part = rest_.first(count);
        rest_ = rest_.subspan(count);
        return part;
    }

    ByteView rest() const { return rest_; }
    bool isPastEnd() const { return isPastEnd_; }  // a read requested more than was left

  private:
    ByteView rest_;
    bool isPastEnd_ = false;
};

// zstd has one context per thread, because creating a context takes longer than compressing a chunk. Any
// thread may call the functions. Appends one zstd frame to `out`. Deterministic for one version of zstd.
void appendCompressed(Bytes& out, ByteView bytes);

// Decompresses one frame, which must fill `target` exactly.
[[nodiscard]] base::Result<void> decompress(ByteView frame, std::span<std::byte> target);

}  // namespace terrane::store
