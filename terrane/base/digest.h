// 128-bit fingerprint of bytes, for golden results and for telling whether a file changed. Not for security.
// It is XXH3 in 128 bits without a seed, as `xxh128sum` prints it. One thread at a time for each object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace terrane::base {

// How the bytes are cut into updates makes no difference. Movable; a moved-from digest is only good for
// assignment.
class Digest {
  public:
    Digest();

    void update(std::span<const std::byte> bytes);
    void update(std::string_view text);

    // 32 lower-case digits for what was given so far; more may follow.
    [[nodiscard]] std::string hex() const;

  private:
    struct FreeState {
        void operator()(XXH3_state_s* state) const;
    };
    std::unique_ptr<XXH3_state_s, FreeState> state_;
};

// 64 bits, the same on every machine: xxHash64 of the bytes with the seed 0, as `xxh64sum` prints it.
[[nodiscard]] std::uint64_t hash64(std::string_view text);

}  // namespace terrane::base
