// Parses a seed: a number or any text. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::app {

struct WrittenSeed {
    std::uint64_t seed = 0;
    std::string text;  // the text whose base::hash64 is the seed; empty for a number
};

// A number from 0 to 2^64 − 1, or any other text. Fails for an empty text, and for a whole number out of
// range: hashed as a text it would give a world that the number does not identify.
[[nodiscard]] base::Result<WrittenSeed> seedFrom(std::string_view text);

}  // namespace terrane::app
