// Quantiles of measured values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace terrane::app {

// The value that a `share` (0 to 1) of the values does not exceed; 0 without values.
inline double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at =
        std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
    return values[at];
}

}  // namespace terrane::app
