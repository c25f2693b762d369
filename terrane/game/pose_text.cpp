#include "terrane/game/pose_text.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace terrane::game {

std::string textOf(const world::Pose& pose) {
    const glm::dvec3& p = pose.position;
    return fmt::format("{} {} {} {} {}", p.x, p.y, p.z, pose.yaw, pose.pitch);
}

std::optional<world::Pose> poseFrom(const std::string& text) {
    std::istringstream in(text);
    world::Pose pose;
    in >> pose.position.x >> pose.position.y >> pose.position.z >> pose.yaw >> pose.pitch;
    const bool isGood = !in.fail() && (in >> std::ws).eof() && std::isfinite(pose.yaw) &&
                        std::abs(pose.pitch) <= 90 && std::isfinite(pose.position.z) &&
                        std::abs(pose.position.x) < 0x1p31 && std::abs(pose.position.y) < 0x1p31 &&
                        world::isInWorld(world::chunkOf(pose.position));
    return isGood ? std::optional(pose) : std::nullopt;
}

}  // namespace terrane::game
