// The median of numbers.
#pragma once

#include <algorithm>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::base {

// The median of at least one value; of an even number, the mean of the middle two.
inline double medianOf(std::vector<double> values) {
    require(!values.empty(), "medianOf: no values");
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace terrane::base
