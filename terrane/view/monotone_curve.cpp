#include "terrane/view/monotone_curve.h"

#include <algorithm>
#include <cmath>

#include "terrane/base/require.h"

namespace terrane::view {
namespace {

// Slopes for which cubic Hermite pieces are monotone: F. N. Fritsch and J. Butland, "A Method for
// Constructing Local Monotone Piecewise Cubic Interpolants", SIAM J. Sci. Stat. Comput. 5 (1984). Zero where
// the values turn, else the weighted harmonic mean of the slopes on both sides.
double slopeBetween(double widthBefore, double before, double widthAfter, double after) {
    if (before * after <= 0) return 0;
    const double weightBefore = 2 * widthAfter + widthBefore, weightAfter = widthAfter + 2 * widthBefore;
    return (weightBefore + weightAfter) / (weightBefore / before + weightAfter / after);
}

// Slope at an end, from the parabola through three values, limited so that the curve does not overshoot.
double slopeAtEnd(double width, double near, double widthNext, double next) {
    const double slope = ((2 * width + widthNext) * near - width * next) / (width + widthNext);
    if (slope * near <= 0) return 0;
    const bool turns = near * next <= 0;
    return turns && std::abs(slope) > 3 * std::abs(near) ? 3 * near : slope;
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)), slopes_(times_.size(), 0.0) {
    base::require(!times_.empty() && times_.size() == values_.size(),
                  "MonotoneCurve: each value needs a time, and there is at least one");
    const std::size_t pieces = times_.size() - 1;
    if (pieces == 0) return;
    std::vector<double> widths, steps;
    for (std::size_t k = 0; k < pieces; ++k) {
        widths.push_back(times_[k + 1] - times_[k]);
        base::require(widths.back() > 0, "MonotoneCurve: times ascend");
        steps.push_back((values_[k + 1] - values_[k]) / widths.back());
    }
    if (pieces == 1) {
        slopes_.assign(2, steps[0]);
        return;
    }
    for (std::size_t k = 1; k < pieces; ++k)
        slopes_[k] = slopeBetween(widths[k - 1], steps[k - 1], widths[k], steps[k]);
    slopes_.front() = slopeAtEnd(widths[0], steps[0], widths[1], steps[1]);
    slopes_.back() = slopeAtEnd(widths[pieces - 1], steps[pieces - 1], widths[pieces - 2], steps[pieces - 2]);
}

double MonotoneCurve::at(double time) const {
    if (time <= times_.front()) return values_.front();
    if (time >= times_.back()) return values_.back();
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    const auto k = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double width = times_[k + 1] - times_[k], t = (time - times_[k]) / width, s = 1 - t;
    return values_[k] * s * s * (1 + 2 * t) + values_[k + 1] * t * t * (3 - 2 * t) +
           width * s * t * (slopes_[k] * s - slopes_[k + 1] * t);
}

}  // namespace terrane::view
