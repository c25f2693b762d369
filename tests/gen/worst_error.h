// The largest of some errors.
#pragma once

#include <cmath>

namespace terrane::gen {

// NaN is larger than any error, and stays.
inline void raise(double& worst, double error) {
    if (!std::isnan(worst) && !(error <= worst)) worst = error;
}

}  // namespace terrane::gen
