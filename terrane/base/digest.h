// A 128-bit digest of bytes, for golden results and for detecting changed files, not for security. It is XXH3
// in 128 bits without a seed, as `xxh128sum` prints it. One thread at a time may use an object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace terrane::base {

// The result does not depend on how the bytes are split into updates. It is movable; a moved-from digest may
// only be assigned to.
class Digest {
  public:
    Digest();

    void update(std::span<const std::byte> bytes);
    void update(std::string_view text);

    // Returns 32 lower-case hexadecimal digits for the bytes given so far; more may follow.
    [[nodiscard]] std::string hex() const;

  private:
    struct FreeState {
        void operator()(XXH3_state_s* state) const;
    };
    std::unique_ptr<XXH3_state_s, FreeState> state_;
};

// Returns 64 bits, the same on every machine: xxHash64 of the bytes with the seed 0, as `xxh64sum` prints it.
[[nodiscard]] std::uint64_t hash64(std::string_view text);

}  // namespace terrane::base
