// Camera and time of day between the keys of a shot. Any thread may use it.
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

#include "terrane/render/frame/camera.h"
#include "terrane/world/pose.h"

namespace terrane::view {

// These convert between the pose of a player and a camera.
inline render::Camera cameraOf(const world::Pose& pose, float fieldOfView = render::Camera().fieldOfView) {
    return {pose.position, pose.yaw, pose.pitch, fieldOfView};
}
inline world::Pose poseOf(const render::Camera& camera) {
    return {camera.position, camera.yaw, camera.pitch};
}

// Returns the distance in blocks at which the fog is complete.
inline float fogDistance(int viewDistance) {
    return static_cast<float>(viewDistance) * static_cast<float>(world::kChunkSize);
}

// A smooth curve through values at given times. Between two values it stays between them, without overshoot.
// Any thread may use it.
class MonotoneCurve {
  public:
    // There are as many times as values, at least one; times ascend strictly.
    MonotoneCurve(std::vector<double> times, std::vector<double> values);

    // Returns the value at a time: the first value before the first time, the last one after the last.
    double at(double time) const;

  private:
    std::vector<double> times_, values_, slopes_;
};

struct CameraKey {
    double time = 0;  // seconds from the start of the shot
    glm::dvec3 position{0.0};
    double yaw = 0, pitch = 0;         // degrees
    std::optional<glm::dvec3> lookAt;  // a point, in place of yaw and pitch
    double timeDay = 0.5;              // only its fraction counts: 0.4 to 1.4 is a whole day
    double fieldOfView = 70;           // degrees
};

struct PathPoint {
    render::Camera camera;
    float timeDay = 0.5f;  // 0…1
};

// Each component follows a MonotoneCurve. Yaw turns the shorter way from key to key. If the keys have points
// to look at, the point moves.
class CameraPath {
  public:
    // `keys`: at least one, times ascend strictly; all look at points or none does.
    explicit CameraPath(std::vector<CameraKey> keys);

    PathPoint at(double seconds) const;

  private:
    bool looksAtPoints_;
    MonotoneCurve x_, y_, z_;
    MonotoneCurve aimX_, aimY_, aimZ_;  // yaw and pitch, or the point
    MonotoneCurve timeDay_, fieldOfView_;
};

// The direction from one point to another, degrees.
struct Look {
    double yaw = 0, pitch = 0;
};
Look lookFrom(glm::dvec3 eye, glm::dvec3 point);

}  // namespace terrane::view
