#pragma once

#include <limits>

namespace terrane::gen {

inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

}  // namespace terrane::gen
