#include "apps/terrane/flight.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <map>

#include "apps/terrane/median.h"

namespace terrane::app {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Draws frames and logs them.
class Pilot {
  public:
    Pilot(WorldSession& session, render::Renderer& renderer, WorldView& view, const Flight& flight)
        : session_(session), renderer_(renderer), view_(view), flight_(flight), camera_(flight.start) {}

    FlightLog run() {
        while (!frame().complete()) {
        }
        log_.takeOff = last_;
        const double yaw = glm::radians(static_cast<double>(camera_.yaw));
        stream::Progress progress;
        while (last_ < log_.takeOff + flight_.seconds) {
            const double way = kFlightSpeed * (secondsSince(start_) - log_.takeOff);
            camera_.position = flight_.start.position + way * glm::dvec3(std::cos(yaw), std::sin(yaw), 0);
            progress = frame();
        }
        log_.landing = last_;
        log_.missing = progress.wanted - progress.visible;
        while (!frame().complete()) {
        }
        log_.end = last_;
        log_.camera = camera_;
        return std::move(log_);
    }

  private:
    stream::Progress frame() {
        view_.follow(camera_, flight_.viewDistance);
        view_.upload(uploadBudget(secondsSince(start_) - last_));
        renderer_.draw({camera_, world::environmentAt(flight_.timeDay), fogDistance(flight_.viewDistance),
                        static_cast<float>(last_), render::View::Color, isUnderWater(session_, camera_)});
        glFinish();
        const stream::Progress progress = session_.pipeline->progress();
        const double now = secondsSince(start_);
        log_.frames.push_back({now, 1000 * (now - last_), progress.visible, session_.world.chunks().size()});
        last_ = now;
        return progress;
    }

    WorldSession& session_;
    render::Renderer& renderer_;
    WorldView& view_;
    const Flight& flight_;
    render::Camera camera_;
    FlightLog log_;
    Clock::time_point start_ = Clock::now();
    double last_ = 0;  // seconds, of the frame before
};

std::vector<double> flightFrames(const FlightLog& log) {
    std::vector<double> milliseconds;
    for (const FlightFrame& frame : log.frames)
        if (frame.seconds > log.takeOff && frame.seconds <= log.landing)
            milliseconds.push_back(frame.milliseconds);
    return milliseconds;
}

nlohmann::json linesBySecond(const FlightLog& log) {
    std::map<int, std::vector<FlightFrame>> seconds;
    for (const FlightFrame& frame : log.frames) seconds[static_cast<int>(frame.seconds)].push_back(frame);
    nlohmann::json lines;
    for (const auto& [second, frames] : seconds) {
        const auto slowest = std::ranges::max_element(frames, {}, &FlightFrame::milliseconds);
        lines["seconds"].push_back(second);
        lines["frames"].push_back(frames.size());
        lines["slowest_ms"].push_back(slowest->milliseconds);
        lines["visible"].push_back(frames.back().visible);
        lines["active"].push_back(frames.back().active);
    }
    return lines;
}

}  // namespace

FlightLog fly(WorldSession& session, render::Renderer& renderer, WorldView& view, const Flight& flight) {
    return Pilot(session, renderer, view, flight).run();
}

nlohmann::json jsonOf(const FlightLog& log) {
    const std::vector<double> frames = flightFrames(log);
    const double median = medianOf(frames);
    return {{"seconds_to_load", log.takeOff},
            {"seconds_of_flight", log.landing - log.takeOff},
            {"seconds_to_load_again", log.end - log.landing},
            {"chunks_missing_on_landing", log.missing},
            {"frames", frames.size()},
            {"frame_ms", median},
            {"slowest_frame_ms", *std::ranges::max_element(frames)},
            {"frames_over_twice_the_median",
             std::ranges::count_if(frames, [&](double ms) { return ms > 2 * median; })},
            {"by_second", linesBySecond(log)}};
}

}  // namespace terrane::app
