// A flight straight ahead, up or down at full speed, as in the window: in real time, with frames drawn while
// chunks load. Records the time of each frame.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "terrane/view/world_view.h"

namespace terrane::view {

enum class FlightWay { Ahead, Up, Down };

struct Flight {
    render::Camera start;
    FlightWay way = FlightWay::Ahead;
    double seconds = 20;  // of flying
    int viewDistance = 16;
    float timeDay = 0.4f;
};

struct FlightFrame {
    double seconds = 0;  // start of the frame, since take-off
    // Milliseconds of the frame and of its parts; each includes its work on the GPU.
    double all = 0, follow = 0, upload = 0, draw = 0;
    // CPU time of this thread in these parts: if other programs use the machine too, any part of a frame may
    // have to wait for them.
    double followCpu = 0, uploadCpu = 0;
    std::size_t uploads = 0, visible = 0, inView = 0, active = 0, queued = 0;  // chunks

    double loadingCpu() const { return followCpu + uploadCpu; }
};

// The camera waits until all in view is loaded, moves, and waits again until all is loaded.
struct FlightLog {
    std::vector<FlightFrame> frames;
    std::size_t flightBegin = 0, flightEnd = 0;  // frames: the flight's first, the first after it
    double secondsToLoad = 0, secondsOfFlight = 0, secondsToLoadAgain = 0;
    render::Camera camera;    // at the end
    std::size_t missing = 0;  // chunks in view that were not loaded on landing
    int viewDistance = 0;     // at the end: less than requested if GPU memory allows no more
};

// Runs the flight and draws into the renderer's own image, on the thread of the session and of the OpenGL
// context.
FlightLog runFlight(game::Session& session, WorldView& view, render::Renderer& renderer,
                    const Flight& flight);

// Returns the frames of the flight itself; at least one.
std::span<const FlightFrame> framesInFlight(const FlightLog& log);

// Writes frames as CSV, a line a frame.
[[nodiscard]] base::Result<void> writeFrames(const std::string& file, std::span<const FlightFrame> frames);

// Statistics of the frames in flight, in milliseconds.
struct FlightStatistics {
    double median = 0, longest = 0, maxLoading = 0;  // maxLoading: CPU time
    // Frames over twice the median, and those of them that would not be without loading, measured by the
    // clock or by CPU time.
    std::size_t slow = 0, slowByLoadingTime = 0, slowByLoadingCpu = 0;
};
FlightStatistics statisticsOf(const FlightLog& log);

}  // namespace terrane::view
