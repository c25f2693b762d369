#include "apps/terrane/flight.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "apps/terrane/median.h"
#include "terrane/game/player.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpuMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) / 1e6;
}

// Draws frames and logs them.
class Pilot {
  public:
    Pilot(Offscreen& world, const Flight& flight)
        : world_(world), flight_(flight), player_(view::poseOf(flight.start), game::Movement::Fast) {}

    FlightLog run() {
        log_.secondsToLoad = standUntilLoaded();
        const auto takeOff = Clock::now();
        log_.takeOff = log_.frames.size();
        lastFrame_ = takeOff;
        do {
            frame({.forward = true});
            log_.secondsOfFlight = secondsSince(takeOff);
        } while (log_.secondsOfFlight < flight_.seconds);
        log_.landing = log_.frames.size();
        const FlightFrame& last = log_.frames.back();
        log_.missing = std::min(last.wanted, last.wanted - last.visible + view_.waiting());
        log_.secondsToLoadAgain = standUntilLoaded();
        log_.camera = camera();
        for (FlightFrame& frame : log_.frames)
            frame.seconds -= std::chrono::duration<double>(takeOff - start_).count();
        return std::move(log_);
    }

  private:
    // Seconds that it took.
    double standUntilLoaded() {
        const auto start = Clock::now();
        do frame({});
        while (!isAllThere());
        return secondsSince(start);
    }

    // Also what the GPU is to mesh.
    bool isAllThere() const {
        const stream::ChunkPipeline& pipeline = world_.session->pipeline();
        return pipeline.progress().complete() && pipeline.waitingChanges() == 0 && view_.waiting() == 0;
    }

    void frame(const game::MoveKeys& keys) {
        const auto start = Clock::now();
        const double seconds = std::chrono::duration<double>(start - lastFrame_).count();
        lastFrame_ = start;
        FlightFrame frame;
        frame.seconds = secondsSince(start_);
        const double cpuStart = cpuMilliseconds();
        player_.move(world_.session->world(), world_.session->blocks(), keys, seconds);
        view_.follow(camera(), flight_.viewDistance);
        frame.follow = 1000 * secondsSince(start);
        frame.followCpu = cpuMilliseconds() - cpuStart;

        const auto uploadStart = Clock::now();
        frame.uploads = view_.upload(view::uploadBudget(seconds, view_.missing()));
        glFinish();
        frame.upload = 1000 * secondsSince(uploadStart);
        frame.uploadCpu = cpuMilliseconds() - cpuStart - frame.followCpu;

        const auto drawStart = Clock::now();
        draw(static_cast<float>(frame.seconds));
        frame.draw = 1000 * secondsSince(drawStart);
        frame.all = 1000 * secondsSince(start);
        const stream::ChunkPipeline& pipeline = world_.session->pipeline();
        const stream::Progress progress = pipeline.progress();
        frame.visible = progress.visible;
        frame.wanted = progress.wanted;
        frame.active = world_.session->world().chunkCount();
        frame.queued = pipeline.queuedCount() + view_.waiting();
        log_.frames.push_back(frame);
    }

    render::Camera camera() const { return view::cameraOf(player_.pose(), flight_.start.fieldOfView); }

    void draw(float seconds) {
        const render::Camera from = camera();
        world_.renderer.draw({from, world::environmentAt(flight_.timeDay),
                              view::fogDistance(flight_.viewDistance), seconds, render::View::Color,
                              game::isUnderWater(*world_.session, from.position)});
        glFinish();
    }

    Offscreen& world_;
    view::WorldView& view_ = *world_.view;
    const Flight& flight_;
    game::Player player_;
    FlightLog log_;
    Clock::time_point start_ = Clock::now(), lastFrame_ = start_;
};

nlohmann::json linesBySecond(const FlightLog& log) {
    std::map<int, std::vector<FlightFrame>> seconds;
    const double first = log.frames.front().seconds;
    for (const FlightFrame& frame : log.frames)
        seconds[static_cast<int>(frame.seconds - first)].push_back(frame);
    nlohmann::json lines;
    for (const auto& [second, frames] : seconds) {
        const auto slowest = std::ranges::max_element(frames, {}, &FlightFrame::all);
        lines["seconds"].push_back(second);
        lines["frames"].push_back(frames.size());
        lines["slowest_ms"].push_back(slowest->all);
        lines["visible"].push_back(frames.back().visible);
        lines["active"].push_back(frames.back().active);
    }
    return lines;
}

}  // namespace

FlightLog fly(Offscreen& world, const Flight& flight) {
    return Pilot(world, flight).run();
}

std::span<const FlightFrame> framesInFlight(const FlightLog& log) {
    return std::span(log.frames).subspan(log.takeOff, log.landing - log.takeOff);
}

FlightStatistics statisticsOf(const FlightLog& log) {
    const std::span<const FlightFrame> frames = framesInFlight(log);
    std::vector<double> all;
    for (const FlightFrame& frame : frames) all.push_back(frame.all);
    FlightStatistics statistics{.median = medianOf(all), .longest = *std::ranges::max_element(all)};
    for (const FlightFrame& frame : frames) {
        statistics.maxLoading = std::max(statistics.maxLoading, frame.loadingCpu());
        if (frame.all <= 2 * statistics.median) continue;
        ++statistics.slow;
        if (frame.all - frame.follow - frame.upload <= 2 * statistics.median) ++statistics.slowByLoadingTime;
        if (frame.all - frame.loadingCpu() <= 2 * statistics.median) ++statistics.slowByLoadingCpu;
    }
    return statistics;
}

nlohmann::json jsonOf(const FlightLog& log) {
    const FlightStatistics statistics = statisticsOf(log);
    return {{"seconds_to_load", log.secondsToLoad},
            {"seconds_of_flight", log.secondsOfFlight},
            {"seconds_to_load_again", log.secondsToLoadAgain},
            {"chunks_missing_on_landing", log.missing},
            {"frames", framesInFlight(log).size()},
            {"frame_ms", statistics.median},
            {"slowest_frame_ms", statistics.longest},
            {"most_loading_ms", statistics.maxLoading},
            {"frames_over_twice_the_median", statistics.slow},
            {"of_these_by_loading", statistics.slowByLoadingCpu},
            {"by_second", linesBySecond(log)}};
}

}  // namespace terrane::app
