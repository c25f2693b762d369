// terrane flight-bench: flies straight ahead, up or down at full speed without a window, in real time, and
// records the time of each frame. For plots of frame times (tools/flight_trace.sh) and `terrane bench`.
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/graphics_options.h"
#include "apps/terrane/offscreen.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/flight.h"

namespace terrane::app {
namespace {

struct FlightBenchOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    PlaceOptions place;
    view::FlightWay way = view::FlightWay::Ahead;
    double seconds = 20;
    std::string output;
    bool json = false;
};

// The flight; its view distance is set later.
base::Result<view::Flight> flightOf(const FlightBenchOptions& options) {
    auto place = TERRANE_TRY(placeOf(options.place, {"", {{8, 8, 120}, 45, 0}, 0.4f}));
    // Scenes look down on the ground; the flight looks straight ahead.
    if (!options.place.look) place.pose.pitch = 0;
    return view::Flight{.start = view::cameraOf(place.pose),
                        .way = options.way,
                        .seconds = options.seconds,
                        .timeDay = place.timeDay};
}

void report(const view::FlightLog& log) {
    const view::FlightStatistics statistics = view::statisticsOf(log);
    const glm::dvec3& p = log.camera.position;
    base::logInfo(
        "{} frames to {:.0f},{:.0f},{:.0f}: median {:.1f} ms, longest {:.1f} ms; loading: at most {:.2f} ms "
        "of the CPU",
        view::framesInFlight(log).size(), p.x, p.y, p.z, statistics.median, statistics.longest,
        statistics.maxLoading);
    base::logInfo(
        "{} frames over twice the median; {} of them because of the time in loading, {} because of its CPU "
        "time",
        statistics.slow, statistics.slowByLoadingTime, statistics.slowByLoadingCpu);
}

nlohmann::json linesBySecond(const view::FlightLog& log) {
    std::map<int, std::vector<view::FlightFrame>> seconds;
    const double first = log.frames.front().seconds;
    for (const view::FlightFrame& frame : log.frames)
        seconds[static_cast<int>(frame.seconds - first)].push_back(frame);
    nlohmann::json lines;
    for (const auto& [second, frames] : seconds) {
        const auto slowest = std::ranges::max_element(frames, {}, &view::FlightFrame::all);
        lines["seconds"].push_back(second);
        lines["frames"].push_back(frames.size());
        lines["slowest_ms"].push_back(slowest->all);
        lines["visible"].push_back(frames.back().visible);
        lines["active"].push_back(frames.back().active);
    }
    return lines;
}

// The statistics, with one entry per second.
nlohmann::json jsonOf(const view::FlightLog& log) {
    const view::FlightStatistics statistics = view::statisticsOf(log);
    return {{"view_distance", log.viewDistance},
            {"seconds_to_load", log.secondsToLoad},
            {"seconds_of_flight", log.secondsOfFlight},
            {"seconds_to_load_again", log.secondsToLoadAgain},
            {"chunks_missing_on_landing", log.missing},
            {"frames", view::framesInFlight(log).size()},
            {"frame_ms", statistics.median},
            {"slowest_frame_ms", statistics.longest},
            {"most_loading_ms", statistics.maxLoading},
            {"frames_over_twice_the_median", statistics.slow},
            {"of_these_by_loading", statistics.slowByLoadingCpu},
            {"by_second", linesBySecond(log)}};
}

base::Result<void> runFlightBench(const FlightBenchOptions& options) {
    if (options.output.empty() && !options.json) return base::fail("flight-bench needs --output or --json");
    TERRANE_TRY(checkSaveOptions(options.save));
    auto flight = TERRANE_TRY(flightOf(options));
    auto world = TERRANE_TRY(openOffscreen({.world = worldOf(options.place, options.world),
                                            .save = options.save,
                                            .graphics = options.graphics,
                                            .backend = options.backend,
                                            .access = store::WorldAccess::ReadWrite,
                                            .meshMilliseconds = view::WorldView::kFrameMilliseconds}));
    flight.viewDistance = world->graphics.viewDistance;
    const view::FlightLog log = view::runFlight(*world->session, *world->view, world->renderer, flight);
    if (!options.output.empty()) {
        TERRANE_TRY(view::writeFrames(options.output, view::framesInFlight(log)));
    }
    TERRANE_TRY(world->session->save());
    TERRANE_TRY(world->finish());
    report(log);
    if (options.json) std::cout << nlohmann::json{{"flight", jsonOf(log)}}.dump() << '\n';
    return {};
}

}  // namespace

CommandEntry addFlightBench(CLI::App& app) {
    auto options = std::make_shared<FlightBenchOptions>();
    CLI::App* command = app.add_subcommand("flight-bench", "Fly without a window and record frame times");
    addPlaceOptions(*command, options->place);
    using enum view::FlightWay;
    addChoice<view::FlightWay>(*command, "--way", options->way,
                               {{"ahead", Ahead}, {"up", Up}, {"down", Down}}, "Way of the flight");
    command->add_option("--duration", options->seconds, "Seconds of the flight")
        ->check(numberFrom(0.1, 600))
        ->capture_default_str();
    addOutputOption(*command, options->output, {}, "The CSV file, one line per frame");
    command->get_option("--output")->required(false);
    command->add_flag("--json", options->json, "Print statistics of the flight as JSON");
    addWorldOptions(*command, options->world);
    nameSceneGenerator(*command);
    addBackendOption(*command, options->backend, "Device that generates, lights and meshes");
    addGraphicsOptions(*command, options->graphics, "auto");
    addSaveGameOptions(*command, options->save);
    return {command, [options] { return runFlightBench(*options); }};
}

}  // namespace terrane::app
