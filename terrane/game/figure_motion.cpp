#include "terrane/game/figure_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "terrane/shared/figure.h"
#include "terrane/world/character.h"

namespace terrane::game {
namespace {

// Shorter intervals are poses delayed by a slow network.
constexpr double kShortestInterval = 0.05;
// A motion takes a little longer than the interval to the next pose, so that a late pose does not stop the
// figure. At an even pace the figure is then a fifth of an interval behind at the end, at the true speed.
constexpr double kSlack = 1.2;
// A longer pause means that the player stood still: it tells nothing about the interval.
constexpr double kSilence = 1.5 * FigureMotion::kMaxInterval;

constexpr double kSettle = 10;      // 1/s: rate at which stride size and body follow
constexpr double kLeastStep = 0.3;  // stride size of the shortest steps
// Horizontal speeds, blocks/s: figures fly above the first; their legs hang still at the second.
constexpr double kFlies = 10, kHangs = 15;

double secondsOf(FigureMotion::Time::duration duration) {
    return std::chrono::duration<double>(duration).count();
}

float turnedTo(float from, float to, double share) {
    return from + static_cast<float>(share) * std::remainder(to - from, 360.0f);
}

// The share of a difference that is gone after `seconds` at the rate kSettle.
double settled(double seconds) {
    return 1 - std::exp(-kSettle * seconds);
}

// Steps get longer with the square root of the speed, so that they get more frequent, too.
double strideSizeAt(double speed) {
    const double onFoot = std::sqrt(std::min(speed / world::kRunSpeed, 1.0));
    return onFoot * std::clamp((kHangs - speed) / (kHangs - kFlies), 0.0, 1.0);
}

// A foot on the ground goes from one end of its swing to the other while the body passes over it.
double stepBlocks(double strideSize) {
    const double swing = double{shared::kFigureMostSwing} * std::max(strideSize, kLeastStep);
    return 2 * double{shared::kFigureLeg} * std::sin(swing);
}

}  // namespace

FigureMotion::FigureMotion(const world::Pose& pose, Time now, std::uint32_t look)
    : from_(pose), to_(pose), since_(now), shownTime_(now) {
    figure_.eyes = pose.position;
    figure_.bodyYaw = pose.yaw;
    figure_.look = look;
}

void FigureMotion::addPose(const world::Pose& pose, Time now) {
    const double silence = secondsOf(now - since_);
    if (silence < kSilence) {
        const double measured = std::clamp(silence, kShortestInterval, kMaxInterval);
        interval_ = measured > interval_ ? measured : (interval_ + measured) / 2;
    }
    from_ = shownAt(now);
    to_ = pose;
    since_ = now;
    waySeconds_ = kSlack * interval_;
    if (glm::distance(from_.position, to_.position) <= kJumpBlocks) return;
    from_ = to_;
    figure_.eyes = to_.position;
    figure_.bodyYaw = to_.yaw;
}

world::Pose FigureMotion::shownAt(Time now) const {
    const double share = waySeconds_ > 0 ? std::clamp(secondsOf(now - since_) / waySeconds_, 0.0, 1.0) : 1;
    world::Pose pose;
    pose.position = glm::mix(from_.position, to_.position, share);
    pose.yaw = turnedTo(from_.yaw, to_.yaw, share);
    pose.pitch = glm::mix(from_.pitch, to_.pitch, static_cast<float>(share));
    return pose;
}

// The legs run backward if the body faces against the motion.
void FigureMotion::walk(glm::dvec2 step, double seconds) {
    const double blocks = glm::length(step);
    if (seconds > 0) {
        const double aim = strideSizeAt(blocks / seconds), size = double{figure_.strideSize};
        figure_.strideSize = static_cast<float>(size + (aim - size) * settled(seconds));
    }
    const double yaw = glm::radians(double{figure_.bodyYaw});
    const bool isBack = glm::dot(step, glm::dvec2(std::cos(yaw), std::sin(yaw))) < 0;
    const double phase = std::numbers::pi * blocks / stepBlocks(double{figure_.strideSize});
    figure_.stride = static_cast<float>(
        std::remainder(double{figure_.stride} + (isBack ? -phase : phase), 2 * std::numbers::pi));
}

// Turns the body toward the motion, or away from it when walking backward, never far from the head.
void FigureMotion::turnBody(glm::dvec2 step, double seconds) {
    constexpr double kStands = 0.2;  // blocks a second
    if (glm::length(step) > kStands * seconds) {
        const auto way = static_cast<float>(glm::degrees(std::atan2(step.y, step.x)));
        const float aside = std::remainder(way - figure_.yaw, 360.0f);
        const float toward = std::abs(aside) > 110 ? way + 180 : way;
        figure_.bodyYaw = turnedTo(figure_.bodyYaw, toward, settled(seconds));
    }
    const float lag = std::remainder(figure_.bodyYaw - figure_.yaw, 360.0f);
    figure_.bodyYaw = std::remainder(figure_.yaw + std::clamp(lag, -kMaxBodyLag, kMaxBodyLag), 360.0f);
}

world::Figure FigureMotion::at(Time now) {
    const double seconds = secondsOf(now - shownTime_);
    shownTime_ = now;
    const world::Pose pose = shownAt(now);
    const glm::dvec2 step = glm::dvec2(pose.position) - glm::dvec2(figure_.eyes);
    figure_.eyes = pose.position;
    figure_.yaw = pose.yaw;
    figure_.pitch = pose.pitch;
    turnBody(step, seconds);
    walk(step, seconds);
    const double swung = swungAt_ == Time::min() ? kSwingSeconds : secondsOf(now - swungAt_);
    figure_.swing = swung < kSwingSeconds ? static_cast<float>(swung / kSwingSeconds) : 0.0f;
    return figure_;
}

}  // namespace terrane::game
