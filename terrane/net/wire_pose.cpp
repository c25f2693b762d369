#include "terrane/net/wire_pose.h"

#include <algorithm>
#include <cmath>

namespace terrane::net {
namespace {

constexpr double kFullTurn = 65536, kStraightUp = 32767;

std::int64_t steps(double blocks) {
    return std::llround(blocks * kPoseSteps);
}

}  // namespace

WirePose wirePose(const world::Pose& pose) {
    const glm::dvec3& p = pose.position;
    const long long turn = std::llround(double{pose.yaw} / 360 * kFullTurn);
    const double up = std::clamp(double{pose.pitch} / 90, -1.0, 1.0) * kStraightUp;
    return {steps(p.x), steps(p.y), steps(p.z), static_cast<std::uint16_t>(turn & 0xFFFF),
            static_cast<std::int16_t>(std::lround(up))};
}

double distanceBetween(const WirePose& a, const WirePose& b) {
    const auto dx = static_cast<double>(a.x - b.x), dy = static_cast<double>(a.y - b.y),
               dz = static_cast<double>(a.z - b.z);
    return std::sqrt(dx * dx + dy * dy + dz * dz) / kPoseSteps;
}

world::Pose poseOf(const WirePose& pose) {
    const auto blocks = [](std::int64_t v) { return static_cast<double>(v) / kPoseSteps; };
    return {{blocks(pose.x), blocks(pose.y), blocks(pose.z)},
            static_cast<float>(pose.yaw / kFullTurn * 360),
            static_cast<float>(pose.pitch / kStraightUp * 90)};
}

}  // namespace terrane::net
