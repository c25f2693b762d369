// The ends of the world's coordinates.
#pragma once

#include <cstdint>
#include <limits>

namespace terrane::world {

inline constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

}  // namespace terrane::world
