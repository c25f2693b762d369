// Conversions between the pose of a player and a camera.
#pragma once

#include "terrane/render/camera.h"
#include "terrane/world/pose.h"

namespace terrane::view {

inline render::Camera cameraOf(const world::Pose& pose, float fieldOfView = render::Camera().fieldOfView) {
    return {pose.position, pose.yaw, pose.pitch, fieldOfView};
}
inline world::Pose poseOf(const render::Camera& camera) {
    return {camera.position, camera.yaw, camera.pitch};
}

// Distance in blocks at which the fog is complete.
inline float fogDistance(int viewDistance) {
    return static_cast<float>(viewDistance) * static_cast<float>(world::kChunkSize);
}

}  // namespace terrane::view
