// A flight through the world as the window would show it: frames are drawn while chunks load. What each frame
// took is kept.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "apps/terrane/world_view.h"

namespace terrane::app {

struct Flight {
    render::Camera start;  // flies ahead from here, at the same height
    double seconds = 20;   // of flying
    int viewDistance = 16;
    float timeDay = 0.5f;
};

struct FlightFrame {
    double seconds = 0;                   // since the start, when it was on screen
    double milliseconds = 0;              // since the frame before
    std::size_t visible = 0, active = 0;  // chunks
};

struct FlightLog {
    std::vector<FlightFrame> frames;
    double takeOff = 0, landing = 0, end = 0;  // seconds; all in view was there at the first and at the last
    render::Camera camera;                     // at the end
    std::size_t missing = 0;                   // chunks in view that were not there on landing
};

constexpr double kFlightSpeed = 60;  // blocks a second: the fastest that one moves in the window

// Waits until all in view is there, flies, waits again.
FlightLog fly(WorldSession& session, render::Renderer& renderer, WorldView& view, const Flight& flight);

// The figures, and a line of them for each second.
nlohmann::json jsonOf(const FlightLog& log);

}  // namespace terrane::app
