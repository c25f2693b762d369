#include "terrane/view/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "terrane/base/require.h"

namespace terrane::view {
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
