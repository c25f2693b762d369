// Moves the figure of another player smoothly between received poses: every 0.1 s from near players, every
// second from far ones, none while a player stands still. One for each player, on the thread that draws.
#pragma once

#include <chrono>
#include <cstdint>

#include "terrane/world/pose.h"

namespace terrane::game {

class FigureMotion {
  public:
    using Time = std::chrono::steady_clock::time_point;

    static constexpr double kMaxInterval = 1;  // seconds between two poses of a moving player
    static constexpr double kJumpBlocks = 32;  // a longer step is taken at once
    static constexpr double kSwingSeconds = 0.3;
    static constexpr float kMaxBodyLag = 50;  // degrees between head and body

    FigureMotion(const world::Pose& pose, Time now, std::uint32_t look);

    // Sets the newest pose, which has just arrived.
    void addPose(const world::Pose& pose, Time now);
    // Starts a swing of the arm.
    void swing(Time now) { swungAt_ = now; }
    // Returns the figure at `now`, which never decreases. The program calls it once a frame: the steps of the
    // legs follow from the distance moved since the last call.
    world::Figure at(Time now);

  private:
    world::Pose shownAt(Time now) const;
    void walk(glm::dvec2 step, double seconds);
    void turnBody(glm::dvec2 step, double seconds);

    // The motion in progress starts where the figure was when the newest pose arrived.
    world::Pose from_, to_;
    Time since_;
    double waySeconds_ = 0;

    double interval_ = 0.1;  // seconds between poses, measured
    Time shownTime_;         // of the last figure
    Time swungAt_ = Time::min();
    world::Figure figure_;  // the last one
};

}  // namespace terrane::game
