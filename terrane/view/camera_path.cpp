#include "terrane/view/camera_path.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

#include "terrane/base/result.h"

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

namespace {

using Keys = std::vector<CameraKey>;

template <class Value>
MonotoneCurve curveOf(const Keys& keys, Value value) {
    std::vector<double> times, values;
    for (const CameraKey& key : keys) {
        times.push_back(key.time);
        values.push_back(value(key));
    }
    return {std::move(times), std::move(values)};
}

// Makes each yaw differ by at most half a turn from the one before.
Keys unwound(Keys keys) {
    for (std::size_t k = 1; k < keys.size(); ++k) {
        const double turn = keys[k].yaw - keys[k - 1].yaw;
        keys[k].yaw = keys[k - 1].yaw + std::remainder(turn, 360.0);
    }
    return keys;
}

MonotoneCurve aimCurve(const Keys& keys, glm::length_t axis) {
    const auto aim = [axis](const CameraKey& key) {
        return key.lookAt.value_or(glm::dvec3(key.yaw, key.pitch, 0))[axis];
    };
    return curveOf(keys, aim);
}

MonotoneCurve positionCurve(const Keys& keys, glm::length_t axis) {
    return curveOf(keys, [axis](const CameraKey& key) { return key.position[axis]; });
}

}  // namespace

Look lookFrom(glm::dvec3 eye, glm::dvec3 point) {
    const glm::dvec3 d = point - eye;
    return {glm::degrees(std::atan2(d.y, d.x)), glm::degrees(std::atan2(d.z, std::hypot(d.x, d.y)))};
}

CameraPath::CameraPath(std::vector<CameraKey> keys)
    : looksAtPoints_(!keys.empty() && keys.front().lookAt.has_value()),
      x_(positionCurve(keys, 0)),
      y_(positionCurve(keys, 1)),
      z_(positionCurve(keys, 2)),
      aimX_(aimCurve(unwound(keys), 0)),
      aimY_(aimCurve(keys, 1)),
      aimZ_(aimCurve(keys, 2)),
      timeDay_(curveOf(keys, [](const CameraKey& key) { return key.timeDay; })),
      fieldOfView_(curveOf(keys, [](const CameraKey& key) { return key.fieldOfView; })) {
    base::require(
        std::ranges::all_of(keys, [&](const CameraKey& k) { return k.lookAt.has_value() == looksAtPoints_; }),
        "CameraPath: all keys look at points, or none does");
}

PathPoint CameraPath::at(double seconds) const {
    const glm::dvec3 position(x_.at(seconds), y_.at(seconds), z_.at(seconds));
    const glm::dvec3 aim(aimX_.at(seconds), aimY_.at(seconds), aimZ_.at(seconds));
    const Look look = looksAtPoints_ ? lookFrom(position, aim) : Look{aim.x, aim.y};
    const double day = timeDay_.at(seconds);
    return {{position, static_cast<float>(look.yaw), static_cast<float>(look.pitch),
             static_cast<float>(fieldOfView_.at(seconds))},
            static_cast<float>(day - std::floor(day))};
}

}  // namespace terrane::view
