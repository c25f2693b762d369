// Moves the figure of another player smoothly through poses that arrive now and then: every 0.1 s from near
// ones, every second from far ones, none while somebody stands still. One for each player, on the thread
// that draws.
#pragma once

#include <chrono>
#include <cstdint>

#include "terrane/world/figure.h"
#include "terrane/world/pose.h"

namespace terrane::game {

class FigureMotion {
  public:
    using Time = std::chrono::steady_clock::time_point;

    static constexpr double kLongestInterval = 1;  // seconds between two poses of somebody who moves
    static constexpr double kJumpBlocks = 32;      // a longer step is taken at once
    static constexpr double kSwingSeconds = 0.3;
    static constexpr float kMostBodyLag = 50;  // degrees between head and body

    FigureMotion(const world::Pose& pose, Time now, std::uint32_t look);

    // The newest pose, which has just arrived.
    void told(const world::Pose& pose, Time now);
    // The player did something with the hand.
    void swing(Time now) { swungAt_ = now; }
    // Once a frame: the steps of legs follow from the way since the last call. `now` never goes back.
    world::Figure at(Time now);

  private:
    world::Pose shownAt(Time now) const;
    void walk(glm::dvec2 step, double seconds);
    void turnBody(glm::dvec2 step, double seconds);

    // The way in progress: from where the figure was when the newest pose arrived.
    world::Pose from_, to_;
    Time since_;
    double waySeconds_ = 0;

    double interval_ = 0.1;  // seconds between poses, measured
    Time shownTime_;         // of the last figure
    Time swungAt_ = Time::min();
    world::Figure figure_;  // the last one
};

}  // namespace terrane::game
