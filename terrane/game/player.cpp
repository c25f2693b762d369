#include "terrane/game/player.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace terrane::game {
namespace {

// The ends of the world. Messages round positions to 1/64 block, which may not lie beyond.
constexpr double kWorldStart = -2147483648.0, kWorldEnd = 2147483648.0 - 1.0 / 64;
// Seconds; a longer stall moves a player no farther.
constexpr double kLongestFrame = 0.25;
// Blocks below and above the world as far as one flies.
constexpr double kRoomBelow = 64, kRoomAbove = 768;

float axis(bool positive, bool negative) {
    return static_cast<float>(positive) - static_cast<float>(negative);
}

glm::vec2 directionOf(const MoveKeys& keys) {
    return {axis(keys.right, keys.left) + keys.stick.x, axis(keys.forward, keys.back) + keys.stick.y};
}

}  // namespace

std::optional<world::Aabb> Player::body() const {
    if (movement_ == Movement::Noclip) return std::nullopt;
    return world::characterBox(now_.feet);
}

void Player::placeAt(const world::Pose& pose, Movement movement) {
    pose_ = pose;
    movement_ = movement;
    now_ = {.feet = pose.position - glm::dvec3(0, 0, world::kEyeHeight)};
    before_ = now_;
    untilStep_ = 0;
}

void Player::turn(double right, double down) {
    pose_.yaw = std::remainder(pose_.yaw - static_cast<float>(right), 360.0f);
    pose_.pitch = std::clamp(pose_.pitch - static_cast<float>(down), -89.9f, 89.9f);
}

void Player::move(const world::World& world, const world::BlockRegistry& blocks, const MoveKeys& keys,
                  double seconds) {
    seconds = std::min(seconds, kLongestFrame);
    if (movement_ == Movement::Noclip)
        passThrough(world.heights(), keys, seconds);
    else
        moveAmongBlocks(world, blocks, keys, seconds);
}

void Player::passThrough(world::Heights heights, const MoveKeys& keys, double seconds) {
    const float speed = keys.run ? kNoclipRunSpeed : kNoclipSpeed;
    const glm::vec2 along = directionOf(keys);
    const glm::vec3 motion = world::lookDirection(pose_.yaw, pose_.pitch) * along.y +
                             world::rightDirection(pose_.yaw) * along.x +
                             glm::vec3(0, 0, axis(keys.up || keys.jump, keys.down));
    const float length = glm::length(motion);
    if (length < 1e-3f) return;
    pose_.position += glm::dvec3(motion / std::max(length, 1.0f)) * (speed * seconds);
    pose_.position.x = std::clamp(pose_.position.x, kWorldStart, kWorldEnd);
    pose_.position.y = std::clamp(pose_.position.y, kWorldStart, kWorldEnd);
    pose_.position.z = std::clamp(pose_.position.z, heights.bottom - kRoomBelow, heights.top + kRoomAbove);
}

void Player::moveAmongBlocks(const world::World& world, const world::BlockRegistry& blocks,
                             const MoveKeys& keys, double seconds) {
    const double yaw = glm::radians(double{pose_.yaw});
    const glm::dvec2 ahead(std::cos(yaw), std::sin(yaw)), right(ahead.y, -ahead.x);
    const glm::vec2 along = directionOf(keys);
    glm::dvec2 direction = ahead * double{along.y} + right * double{along.x};
    direction /= std::max(glm::length(direction), 1.0);
    const world::CharacterInput input{.direction = direction,
                                      .runs = keys.run,
                                      .jumps = keys.jump || keys.up,
                                      .dives = keys.down,
                                      .hasGravity = movement_ == Movement::Walk,
                                      .autoJump = keys.autoJump};
    untilStep_ += seconds;
    for (; untilStep_ >= world::kStepSeconds; untilStep_ -= world::kStepSeconds) {
        before_ = now_;
        now_ = world::advanceCharacter(world, blocks, before_, input);
    }
    pose_.position = world::characterEye(before_, now_, untilStep_ / world::kStepSeconds);
}

}  // namespace terrane::game
