// terrane flight-bench: flies straight ahead at full speed without a window, in real time, and records the
// time of each frame. For plots of frame times (tools/flight_trace.sh) and `terrane bench`.
#include <fmt/ostream.h>

#include <fstream>
#include <iostream>
#include <memory>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/flight.h"
#include "apps/terrane/options.h"
#include "apps/terrane/place_options.h"
#include "terrane/base/log.h"

namespace terrane::app {
namespace {

struct FlightBenchOptions {
    WorldOptions world;
    SaveOptions save;
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    PlaceOptions place;
    double seconds = 20;
    std::string output;
    bool json = false;
};

base::Result<Flight> flightOf(const FlightBenchOptions& options) {
    auto place = placeOf(options.place, {"", {{8, 8, 120}, 45, 0}, 0.4f});
    if (!place) return tl::unexpected(place.error());
    // A scene looks down on the ground.
    if (!options.place.look) place->camera.pitch = 0;
    return Flight{place->camera, options.seconds, options.graphics.viewDistance, place->timeDay};
}

base::Result<void> writeFrames(const std::string& file, std::span<const FlightFrame> frames) {
    std::ofstream out(file);
    out << "time_s,frame_ms,follow_ms,upload_ms,draw_ms,follow_processor_ms,upload_processor_ms,uploads,"
           "visible_chunks,wanted_chunks,queued_chunks\n";
    for (const FlightFrame& f : frames) {
        fmt::print(out, "{:.4f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{},{}\n", f.seconds, f.all,
                   f.follow, f.upload, f.draw, f.followCpu, f.uploadCpu, f.uploads, f.visible, f.wanted,
                   f.queued);
    }
    out.close();
    return out ? base::Result<void>() : base::fail("{}: cannot be written", file);
}

void report(const FlightLog& log) {
    const FlightStatistics statistics = statisticsOf(log);
    const glm::dvec3& p = log.camera.position;
    base::logInfo(
        "{} frames to {:.0f},{:.0f},{:.0f}: median {:.1f} ms, longest {:.1f} ms; loading: at most {:.2f} ms "
        "of the CPU",
        framesInFlight(log).size(), p.x, p.y, p.z, statistics.median, statistics.longest,
        statistics.maxLoading);
    base::logInfo(
        "{} frames over twice the median; without the time in loading {} would not be, without its CPU "
        "time {}",
        statistics.slow, statistics.slowByLoadingTime, statistics.slowByLoadingCpu);
}

base::Result<void> runFlightBench(const FlightBenchOptions& options) {
    if (options.output.empty() && !options.json) return base::fail("flight-bench needs --output or --json");
    auto flight = flightOf(options);
    if (!flight) return tl::unexpected(flight.error());
    auto world = Offscreen::create({.world = options.world,
                                    .save = options.save,
                                    .graphics = options.graphics,
                                    .backend = options.backend,
                                    .meshMilliseconds = view::WorldView::kFrameMilliseconds});
    if (!world) return tl::unexpected(world.error());
    const FlightLog log = fly(**world, *flight);
    if (!options.output.empty()) {
        if (auto written = writeFrames(options.output, framesInFlight(log)); !written) return written;
    }
    if (auto saved = (*world)->session->save(); !saved) return saved;
    if (auto finished = (*world)->finish(); !finished) return finished;
    report(log);
    if (options.json) std::cout << nlohmann::json{{"flight", jsonOf(log)}}.dump() << '\n';
    return {};
}

}  // namespace

CommandEntry addFlightBench(CLI::App& app) {
    auto options = std::make_shared<FlightBenchOptions>();
    CLI::App* command =
        app.add_subcommand("flight-bench", "Fly straight ahead without a window and record frame times");
    addPlaceOptions(*command, options->place);
    command->add_option("--duration", options->seconds, "Seconds of the flight")
        ->check(numberFrom(0.1, 600))
        ->capture_default_str();
    addOutputOption(*command, options->output, "The CSV file, a line a frame");
    command->get_option("--output")->required(false);
    command->add_flag("--json", options->json, "Print statistics of the flight as JSON");
    addWorldOptions(*command, options->world);
    addBackendOption(*command, options->backend, "Where to generate, light and mesh");
    addGraphicsOptions(*command, options->graphics, "auto");
    addSaveGameOptions(*command, options->save);
    return {command, [options] { return runFlightBench(*options); }};
}

}  // namespace terrane::app
