// A seed as people write it. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::app {

struct WrittenSeed {
    std::uint64_t seed = 0;
    std::string text;  // that stands for it (base::hash64); empty where a number was written
};

// A number from 0 to 2^64 − 1, or any other text. A number that is no seed is not a text either: nobody would
// find the world again. An empty text is an error.
[[nodiscard]] base::Result<WrittenSeed> seedFrom(std::string_view text);

}  // namespace terrane::app
