// Wire formats of chunk positions and poses: positions in steps of 1/64 block, directions in 1/65536 turn,
// those of other players in 1/256 turn. Plain values and functions; any thread.
#pragma once

#include <cstdint>

#include "terrane/net/wire.h"
#include "terrane/world/coords.h"
#include "terrane/world/pose.h"

namespace terrane::net {

constexpr double kPoseSteps = 64;                                 // steps per block
constexpr std::int64_t kMaxPosePosition = std::int64_t{1} << 37;  // in steps, either way
constexpr int kPitchStep = 258;  // units of WirePose::pitch per unit of PoseChange::pitch

// A player's pose. Position in steps; blocks are at most 2^31 away, so it fits 38 bits.
struct WirePose {
    std::int64_t x = 0, y = 0, z = 0;
    std::uint16_t yaw = 0;   // 65536 a turn
    std::int16_t pitch = 0;  // 32767 for straight up
    bool operator==(const WirePose&) const = default;
};

inline bool isInRange(const WirePose& pose) {
    const auto isGood = [](std::int64_t v) { return v >= -kMaxPosePosition && v <= kMaxPosePosition; };
    return isGood(pose.x) && isGood(pose.y) && isGood(pose.z);
}

WirePose wirePose(const world::Pose& pose);
world::Pose poseOf(const WirePose& pose);
// In blocks.
double distanceBetween(const WirePose& a, const WirePose& b);

// Movement of another player since its last transmitted pose.
struct PoseChange {
    std::uint16_t slot = 0;
    std::int64_t dx = 0, dy = 0, dz = 0;  // in steps; may be large after teleports
    std::uint8_t yaw = 0;                 // 256 a turn
    std::int8_t pitch = 0;                // 127 for straight up
    bool swings = false;                  // broke or placed a block since
    bool operator==(const PoseChange&) const = default;
};

// A chunk position: level as a byte, then x and y as integers.
template <class Wire, class Pos>
void describeChunkPos(Wire& wire, Pos& pos) {
    wire.fixed(pos.level);
    wire.integer(pos.x);
    wire.integer(pos.y);
    wire.require(pos.level <= world::kMaxLevel && world::isInWorld(pos));
}

template <class Wire, class Pose>
void describePose(Wire& wire, Pose& pose) {
    wire.integer(pose.x);
    wire.integer(pose.y);
    wire.integer(pose.z);
    wire.fixed(pose.yaw);
    wire.fixed(pose.pitch);
    for (const std::int64_t v : {pose.x, pose.y, pose.z})
        wire.require(v >= -kMaxPosePosition && v <= kMaxPosePosition);
}

}  // namespace terrane::net
