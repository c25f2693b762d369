#include "terrane/view/flight.h"

#include <fmt/ostream.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

#include "terrane/base/machine.h"
#include "terrane/base/statistics.h"
#include "terrane/game/player.h"
#include "terrane/view/camera_path.h"

namespace terrane::view {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double cpuMilliseconds() {
    return std::chrono::duration<double, std::milli>(base::threadTime()).count();
}

// Flies, draws frames and logs them.
class Pilot {
  public:
    Pilot(game::Session& session, WorldView& view, render::Renderer& renderer, const Flight& flight)
        : session_(session),
          view_(view),
          renderer_(renderer),
          flight_(flight),
          player_(poseOf(flight.start), game::Movement::Noclip) {}

    FlightLog run() {
        log_.secondsToLoad = standUntilLoaded();
        const auto flightBegin = Clock::now();
        log_.flightBegin = log_.frames.size();
        lastFrame_ = flightBegin;
        const game::MoveKeys keys{.forward = flight_.way == FlightWay::Ahead,
                                  .up = flight_.way == FlightWay::Up,
                                  .down = flight_.way == FlightWay::Down,
                                  .run = true};
        do {
            frame(keys);
            log_.secondsOfFlight = secondsSince(flightBegin);
        } while (log_.secondsOfFlight < flight_.seconds);
        log_.flightEnd = log_.frames.size();
        const FlightFrame& last = log_.frames.back();
        log_.missing = std::min(last.inView, last.inView - last.visible + view_.waiting());
        log_.secondsToLoadAgain = standUntilLoaded();
        log_.camera = camera();
        log_.viewDistance = view_.viewDistance();
        for (FlightFrame& frame : log_.frames)
            frame.seconds -= std::chrono::duration<double>(flightBegin - start_).count();
        return std::move(log_);
    }

  private:
    // Returns the seconds taken.
    double standUntilLoaded() {
        const auto start = Clock::now();
        do frame({});
        while (!isAllThere());
        return secondsSince(start);
    }

    // Whether all chunks in view and all tiles are on screen, and none waits for the GPU to mesh it.
    bool isAllThere() const {
        const stream::ChunkPipeline& pipeline = session_.pipeline();
        return pipeline.progress().complete() && pipeline.waitingChanges() == 0 && view_.waiting() == 0 &&
               view_.missingTiles() + view_.missingClipmapTiles() == 0;
    }

    void frame(const game::MoveKeys& keys) {
        const auto start = Clock::now();
        const double seconds = std::chrono::duration<double>(start - lastFrame_).count();
        lastFrame_ = start;
        FlightFrame frame;
        frame.seconds = secondsSince(start_);
        const double cpuStart = cpuMilliseconds();
        player_.move(session_.world(), session_.blocks(), keys, seconds);
        view_.follow(camera(), flight_.viewDistance);
        frame.follow = 1000 * secondsSince(start);
        frame.followCpu = cpuMilliseconds() - cpuStart;

        const auto uploadStart = Clock::now();
        frame.uploads = view_.upload(uploadBudget(seconds, view_.missing()));
        glFinish();
        frame.upload = 1000 * secondsSince(uploadStart);
        frame.uploadCpu = cpuMilliseconds() - cpuStart - frame.followCpu;

        const auto drawStart = Clock::now();
        draw(static_cast<float>(frame.seconds));
        frame.draw = 1000 * secondsSince(drawStart);
        frame.all = 1000 * secondsSince(start);
        const stream::ChunkPipeline& pipeline = session_.pipeline();
        const stream::Progress progress = pipeline.progress();
        frame.visible = progress.visible;
        frame.inView = progress.inView;
        frame.active = session_.world().chunkCount();
        frame.queued = pipeline.queuedCount() + view_.waiting();
        log_.frames.push_back(frame);
    }

    render::Camera camera() const { return cameraOf(player_.pose(), flight_.start.fieldOfView); }

    void draw(float seconds) {
        const render::Camera from = camera();
        renderer_.draw({from, world::environmentAt(flight_.timeDay), fogDistance(view_.visibleDistance()),
                        seconds, render::View::Color, game::waterAbove(session_, from.position),
                        render::ShadowClipmap::kTilesPerFrame});
        glFinish();
    }

    game::Session& session_;
    WorldView& view_;
    render::Renderer& renderer_;
    const Flight& flight_;
    game::Player player_;
    FlightLog log_;
    Clock::time_point start_ = Clock::now(), lastFrame_ = start_;
};

}  // namespace

FlightLog runFlight(game::Session& session, WorldView& view, render::Renderer& renderer,
                    const Flight& flight) {
    return Pilot(session, view, renderer, flight).run();
}

std::span<const FlightFrame> framesInFlight(const FlightLog& log) {
    return std::span(log.frames).subspan(log.flightBegin, log.flightEnd - log.flightBegin);
}

base::Result<void> writeFrames(const std::string& file, std::span<const FlightFrame> frames) {
    std::ofstream out(file);
    out << "time_s,frame_ms,follow_ms,upload_ms,draw_ms,follow_cpu_ms,upload_cpu_ms,uploads,"
           "visible_chunks,chunks_in_view,queued_chunks\n";
    for (const FlightFrame& f : frames) {
        fmt::print(out, "{:.4f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{},{}\n", f.seconds, f.all,
                   f.follow, f.upload, f.draw, f.followCpu, f.uploadCpu, f.uploads, f.visible, f.inView,
                   f.queued);
    }
    out.close();
    return out ? base::Result<void>() : base::fail("{}: cannot be written", file);
}

FlightStatistics statisticsOf(const FlightLog& log) {
    const std::span<const FlightFrame> frames = framesInFlight(log);
    std::vector<double> all;
    for (const FlightFrame& frame : frames) all.push_back(frame.all);
    FlightStatistics statistics{.median = base::medianOf(all), .longest = *std::ranges::max_element(all)};
    for (const FlightFrame& frame : frames) {
        statistics.maxLoading = std::max(statistics.maxLoading, frame.loadingCpu());
        if (frame.all <= 2 * statistics.median) continue;
        ++statistics.slow;
        if (frame.all - frame.follow - frame.upload <= 2 * statistics.median) ++statistics.slowByLoadingTime;
        if (frame.all - frame.loadingCpu() <= 2 * statistics.median) ++statistics.slowByLoadingCpu;
    }
    return statistics;
}

}  // namespace terrane::view
