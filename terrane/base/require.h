// Checks of public functions for what a caller from outside can get wrong: argument and order of calls. They
// stay in release builds; inner loops assert instead.
#pragma once

#include <stdexcept>

namespace terrane::base {

// Throws std::invalid_argument with `rule`, which names the function, unless the rule holds.
inline void require(bool holds, const char* rule) {
    if (!holds) [[unlikely]]
        throw std::invalid_argument(rule);
}

}  // namespace terrane::base
