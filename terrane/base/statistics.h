// Medians and quantiles of measured values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::base {

// Returns the median of at least one value; of an even number, the mean of the middle two.
inline double medianOf(std::vector<double> values) {
    require(!values.empty(), "medianOf: no values");
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

// Returns the value that a `share` (0 to 1) of the values does not exceed; 0 without values.
inline double quantileOf(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at =
        std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
    return values[at];
}

}  // namespace terrane::base
