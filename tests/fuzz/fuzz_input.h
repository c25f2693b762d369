// Reads numbers, choices and texts from the bytes of a fuzzer. Missing bytes read as 0 or empty, so every
// input is valid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::fuzz {

class FuzzInput {
  public:
    FuzzInput(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

    bool isEmpty() const { return rest_.empty(); }
    std::uint8_t byte() { return static_cast<std::uint8_t>(number(1)); }
    // A little-endian number of `count` bytes.
    std::uint64_t number(std::size_t count) {
        std::uint64_t value = 0;
        for (std::size_t k = 0; k < count && !rest_.empty(); ++k) {
            value |= std::uint64_t{rest_[0]} << (8 * k);
            rest_ = rest_.subspan(1);
        }
        return value;
    }
    template <class Choices>
    const auto& oneOf(const Choices& choices) {
        return choices[byte() % std::size(choices)];
    }
    // The first `count` bytes of the rest.
    std::span<const std::uint8_t> bytes(std::size_t count) {
        const auto taken = rest_.first(count < rest_.size() ? count : rest_.size());
        rest_ = rest_.subspan(taken.size());
        return taken;
    }
    // A text; its length comes first, in one byte.
    std::string_view text() { return textOf(bytes(byte())); }
    std::string_view restAsText() { return textOf(bytes(rest_.size())); }

  private:
    static std::string_view textOf(std::span<const std::uint8_t> bytes) {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    std::span<const std::uint8_t> rest_;
};

// Aborts the fuzzer with a finding if `holds` is false. (Clang 14 has no std::source_location.)
inline void require(bool holds, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    if (holds) return;
    std::fprintf(stderr, "%s:%d: what is required here does not hold\n", file, line);
    std::abort();
}

// An error has a message. Control characters are escaped only when it is printed.
inline void requireReason(const base::Error& error) {
    require(!error.message.empty());
}

}  // namespace terrane::fuzz
