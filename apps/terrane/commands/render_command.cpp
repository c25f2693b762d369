// terrane render: renders one image without a window.
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/graphics_options.h"
#include "apps/terrane/offscreen.h"
#include "apps/terrane/options.h"
#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/statistics.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/frame_times.h"

namespace terrane::app {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct RenderCommandOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    PlaceOptions place;
    float seconds = 0;
    int frames = 0;
    std::string output;
    bool json = false;
};

// Durations in milliseconds.
struct RenderTimings {
    double setUp = 0, load = 0, upload = 0, draw = 0, all = 0;
    view::FrameTimes frames;
    int viewDistance = 0;  // chunks; less than requested if memory is short
};

void tell(const RenderCommandOptions& options, const RenderTimings& timings, const game::Session& session,
          const render::FrameStatistics& statistics) {
    base::logInfo("{}: {} chunks in {:.1f} s, {} quads in {} mesh sections", options.output,
                  session.world().chunkCount(), timings.load / 1000, statistics.quads,
                  statistics.meshSections);
    if (timings.frames.milliseconds.empty()) return;
    const double frame = base::medianOf(timings.frames.milliseconds);
    base::logInfo("a frame takes {:.1f} ms in the middle of {}, {:.1f} frames/s", frame,
                  timings.frames.milliseconds.size(), 1000 / frame);
}

// Triangles of the shadow map over a day: times from 0 to 1.
nlohmann::json shadowsOverTheDay(const render::Renderer& renderer, render::FrameInput input) {
    constexpr int kSteps = 40;
    nlohmann::json day;
    for (int k = 0; k <= kSteps; ++k) {
        const double time = static_cast<double>(k) / kSteps;
        input.environment = world::environmentAt(static_cast<float>(time));
        day["time"].push_back(time);
        day["triangles"].push_back(renderer.shadowTriangles(input));
    }
    return day;
}

nlohmann::json memoryJson(const RenderCommandOptions& options, const game::Session& session,
                          const render::Renderer& renderer) {
    const std::string& world = options.save.world;
    return {{"blocks", session.world().memoryBytes()},
            {"light", session.pipeline().lightBytes()},
            {"light_of_stage_1", session.pipeline().localLightBytes()},
            {"generator_cache", session.generator().cacheBytes()},
            {"light_gpu", renderer.lightBytes()},
            {"quads_gpu", renderer.quadBytes()},
            {"gpu", renderer.memory().total()},
            {"gpu_budget", renderer.memoryBudget()},
            {"save", world.empty() ? 0 : store::bytesOnDisk(store::worldLocation(world))},
            {"process", base::residentBytes()},
            {"process_peak", base::peakResidentBytes()}};
}

nlohmann::json tasksJson(const game::Session& session) {
    nlohmann::json tasks = nlohmann::json::object();
    for (const stream::TaskTime& task : session.taskTimes())
        tasks[task.name] = {{"count", task.count}, {"milliseconds", task.microseconds / 1000}};
    return tasks;
}

nlohmann::json imageJson(const RenderCommandOptions& options, const RenderTimings& timings,
                         const game::Session& session, render::Renderer& renderer,
                         const render::FrameInput& input) {
    const render::FrameStatistics statistics = renderer.statistics();
    nlohmann::json result = {{"file", options.output},
                             {"milliseconds",
                              {{"set_up", timings.setUp},
                               {"load", timings.load},
                               {"upload", timings.upload},
                               {"draw", timings.draw},
                               {"all", timings.all}}},
                             {"tasks", tasksJson(session)},
                             {"chunks", session.world().chunkCount()},
                             {"view_distance", timings.viewDistance},
                             {"chunks_in_view", session.pipeline().progress().inView},
                             {"quads", statistics.quads},
                             {"regions", statistics.meshSections},
                             {"draw_commands", statistics.drawCommands},
                             {"triangles",
                              {{"opaque", statistics.opaqueTriangles},
                               {"transparent", statistics.transparentTriangles},
                               {"shadow", renderer.shadowTriangles(input)}}},
                             {"shadow_triangles_over_the_day", shadowsOverTheDay(renderer, input)},
                             {"bytes", memoryJson(options, session, renderer)}};
    if (!timings.frames.milliseconds.empty()) {
        result["milliseconds"]["frame"] = base::medianOf(timings.frames.milliseconds);
        result["milliseconds"]["frame_processor"] = timings.frames.cpuMilliseconds;
        result["passes"] = view::passMedians(timings.frames);
    }
    return result;
}

base::Result<void> renderImage(const RenderCommandOptions& options) {
    const auto start = Clock::now();
    if (!options.place.scene && !options.place.at) return base::fail("render needs --scene or --at");
    const auto place = TERRANE_TRY(placeOf(options.place, {"", {}, content::scenes().front().timeDay}));
    auto world = openOffscreen({.world = worldOf(options.place, options.world),
                                .save = options.save,
                                .graphics = options.graphics,
                                .backend = options.backend});
    if (!world) return tl::unexpected(world.error());
    game::Session& session = *(*world)->session;
    render::Renderer& renderer = (*world)->renderer;
    const int viewDistance = (*world)->graphics.viewDistance;
    RenderTimings timings;
    timings.setUp = millisecondsSince(start);

    const render::Camera camera = view::cameraOf(place.pose);
    const auto loadStart = Clock::now();
    timings.upload = view::loadAll(session, *(*world)->view, camera, viewDistance, loadStart);
    timings.load = millisecondsSince(loadStart);
    timings.viewDistance = (*world)->view->viewDistance();

    const auto drawStart = Clock::now();
    const render::FrameInput input{camera,
                                   world::environmentAt(place.timeDay),
                                   view::fogDistance((*world)->view->visibleDistance()),
                                   options.seconds,
                                   options.graphics.view,
                                   game::waterAbove(session, camera.position)};
    renderer.draw(input);
    const base::Image image = renderer.readImage();
    timings.draw = millisecondsSince(drawStart);
    timings.frames = view::measureFrames(renderer, input, options.frames);
    TERRANE_TRY(base::writePng(options.output, image));
    TERRANE_TRY((*world)->finish());

    timings.all = millisecondsSince(start);
    tell(options, timings, session, renderer.statistics());
    if (options.json) std::cout << imageJson(options, timings, session, renderer, input).dump() << '\n';
    return {};
}

}  // namespace

CommandEntry addRender(CLI::App& app) {
    auto options = std::make_shared<RenderCommandOptions>();
    CLI::App* command = app.add_subcommand("render", "Draw an image into a PNG file, without a window");
    addPlaceOptions(*command, options->place);
    command->add_option("--seconds", options->seconds, "Time of the animation of plants, water and clouds")
        ->check(numberFrom(0, 1e6))
        ->capture_default_str();
    command
        ->add_option("--frames", options->frames,
                     "Draw the image this many more times and print the median frame time")
        ->check(numberFrom(0, 100000));
    addOutputOption(*command, options->output, {".png"}, "The PNG file");
    command->add_flag("--json", options->json, "Print timings and counts as JSON");
    addWorldOptions(*command, options->world);
    nameSceneGenerator(*command);
    addBackendOption(*command, options->backend, "Device that generates, lights and meshes");
    addGraphicsOptions(*command, options->graphics, "high");
    addWorldOption(*command, options->save,
                   "World to draw, which stays unchanged; missing chunks are generated");
    return {command, [options] { return renderImage(*options); }};
}

}  // namespace terrane::app
