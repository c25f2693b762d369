// terrane render: renders one image without a window.
#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/commands/progress.h"
#include "apps/terrane/graphics_options.h"
#include "apps/terrane/offscreen.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/statistics.h"
#include "terrane/path/exr.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/eye.h"
#include "terrane/view/frame_times.h"
#include "terrane/view/path_scene.h"

namespace terrane::app {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

enum class RendererKind : std::uint8_t { Quads, Rays, Path };

struct PathOptions {
    int bounces = path::TraceOptions().bounces;
    view::Lens lens;
    bool denoises = false;
    std::string samplesFile;  // empty: none
};

struct RenderCommandOptions {
    RendererKind renderer = RendererKind::Quads;
    std::optional<int> samples;  // of each pixel
    PathOptions path;
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

// Options that only one renderer has.
struct RendererFormat {
    RendererKind kind;
    std::string name;
    std::vector<std::string_view> options;
};
const std::vector<RendererFormat>& rendererFormats() {
    static const std::vector<RendererFormat> formats{
        {RendererKind::Quads, "--renderer quads", {"--seconds", "--frames", "--view"}},
        {RendererKind::Rays, "--renderer rays", {"--seconds", "--frames", "--view"}},
        {RendererKind::Path, "--renderer path", {"--bounces", "--lens", "--focus", "--denoise", "--resume"}}};
    return formats;
}

bool isExr(const std::string& output) {
    std::string ending = std::filesystem::path(output).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending == ".exr";
}

base::Result<void> checkRenderer(const CLI::App& command, const RenderCommandOptions& options) {
    for (const RendererFormat& format : rendererFormats())
        if (format.kind == options.renderer)
            TERRANE_TRY(checkFormatOptions(command, rendererFormats(), format));
    if (!isExr(options.output)) return {};
    if (options.renderer != RendererKind::Path)
        return base::fail(base::ErrorCode::BadInput, "{}: only --renderer path writes EXR files",
                          options.output);
    if (!path::hasExr())
        return base::fail(base::ErrorCode::Unsupported, "{}: this program was built without OpenEXR",
                          options.output);
    return {};
}

// Traces the samples that the film lacks, a few at a time. Stopped, it keeps those it has.
base::Result<void> traceSamples(path::Film& film, const RenderCommandOptions& options, base::JobSystem& jobs,
                                const std::function<path::Tracer()>& makeTracer, std::uint64_t key) {
    constexpr int kDefaultSamples = 64;
    constexpr std::uint32_t kAtOnce = 4;
    constexpr auto kSaveAfter = std::chrono::seconds(30);
    const auto wanted = static_cast<std::uint32_t>(options.samples.value_or(kDefaultSamples));
    const std::string& file = options.path.samplesFile;
    const auto save = [&]() -> base::Result<void> {
        if (file.empty()) return {};
        return path::saveFilm(file, film, key);
    };
    const io::Progress progress = progressBar("samples");
    auto saved = Clock::now();
    bool goesOn = progress(film.samples, wanted);
    while (goesOn && film.samples < wanted) {
        TERRANE_TRY(path::addSamples(film, std::min(kAtOnce, wanted - film.samples), jobs, makeTracer));
        goesOn = progress(film.samples, wanted);
        if (Clock::now() - saved < kSaveAfter) continue;
        TERRANE_TRY(save());
        saved = Clock::now();
    }
    TERRANE_TRY(save());
    if (film.samples >= wanted) return {};
    return base::fail("stopped after {} of {} samples{}", film.samples, wanted,
                      file.empty() ? "" : fmt::format(", which are in {}", file));
}

base::Result<void> writeTraced(const RenderCommandOptions& options, const path::Film& film,
                               glm::vec3 exposure, base::JobSystem& jobs) {
    path::Means means = path::meansOf(film);
    if (options.path.denoises) path::denoise(means, jobs);
    if (isExr(options.output))
        return path::writeExr(options.output, means, {film.samples, options.path.denoises});
    return base::writePng(options.output, view::displayedImage(means, exposure));
}

base::Result<void> traceImage(const RenderCommandOptions& options, view::Offscreen& world,
                              const render::FrameInput& input, RenderTimings& timings) {
    const auto start = Clock::now();
    const auto scene = TERRANE_TRY(view::makePathScene(world, input));
    timings.upload = millisecondsSince(start);
    const path::TraceOptions trace{.size = options.graphics.size, .bounces = options.path.bounces};
    const path::Camera camera = view::pathCameraOf(input, trace.size, options.path.lens);
    const std::uint64_t key = path::keyOf(*scene, camera, trace);
    path::Film film(trace.size);
    const std::string& file = options.path.samplesFile;
    if (!file.empty() && std::filesystem::exists(file))
        film = TERRANE_TRY(path::loadFilm(file, trace.size, key));
    const std::uint32_t before = film.samples;
    const auto drawStart = Clock::now();
    TERRANE_TRY(traceSamples(
        film, options, world.session->jobs(), [&] { return path::Tracer(*scene, camera, trace); }, key));
    timings.draw = millisecondsSince(drawStart);
    const glm::vec3 exposure = world.graphics.render.adaptation ? input.exposure : glm::vec3(1);
    TERRANE_TRY(writeTraced(options, film, exposure, world.session->jobs()));
    base::logInfo(
        "{}: {} chunks and tiles, {} faces that emit light, {} samples of each pixel, {} of them "
        "in {:.1f} s",
        options.output, scene->parts.tiles.size(), scene->emitters.size(), film.samples,
        film.samples - before, timings.draw / 1000);
    if (options.json)
        std::cout << nlohmann::json{{"file", options.output},
                                    {"milliseconds",
                                     {{"set_up", timings.setUp},
                                      {"load", timings.load},
                                      {"scene", timings.upload},
                                      {"draw", timings.draw}}},
                                    {"samples", film.samples},
                                    {"traced_samples", film.samples - before},
                                    {"tiles", scene->parts.tiles.size()},
                                    {"emitters", scene->emitters.size()}}
                         .dump()
                  << '\n';
    return {};
}

// The options of this command that are graphics options of others. All but the path tracer have a few numbers
// of samples.
base::Result<render::GraphicsChoices> graphicsChoices(const RenderCommandOptions& options) {
    render::GraphicsChoices choices = options.graphics.choices;
    if (options.renderer == RendererKind::Path) return choices;
    const auto table = render::graphicsTable();
    const auto choose = [&](std::string_view name, const std::string& value) -> base::Result<void> {
        const auto row = std::ranges::find(table, name, &render::GraphicsRow::name);
        const auto choice = render::choiceOf(*row, value);
        if (!choice)
            return base::fail(base::ErrorCode::BadInput,
                              "--{}: {} is not one of {} of --renderer quads and rays", name, value,
                              render::valueNamesOf(*row));
        choices.changed.emplace_back(row - table.begin(), *choice);
        return {};
    };
    if (options.renderer == RendererKind::Rays) TERRANE_TRY(choose("renderer", "rays"));
    if (options.samples) TERRANE_TRY(choose("samples", std::to_string(*options.samples)));
    return choices;
}

base::Result<void> renderImage(const CLI::App& command, const RenderCommandOptions& options) {
    const auto start = Clock::now();
    TERRANE_TRY(checkRenderer(command, options));
    GraphicsOptions graphics = options.graphics;
    graphics.choices = TERRANE_TRY(graphicsChoices(options));
    if (!options.place.scene && !options.place.at) return base::fail("render needs --scene or --at");
    const auto place = TERRANE_TRY(placeOf(options.place, {"", {}, content::scenes().front().timeDay}));
    auto world = openOffscreen({.world = worldOf(options.place, options.world),
                                .save = options.save,
                                .graphics = graphics,
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

    if (const auto block = view::blockAtCamera(session, camera))
        base::logWarning("{}: the camera is {}, which it sees through", options.output, *block);

    const auto drawStart = Clock::now();
    render::FrameInput input{camera,
                             world::environmentAt(place.timeDay),
                             view::fogDistance((*world)->view->visibleDistance()),
                             options.seconds,
                             options.graphics.view,
                             game::waterAbove(session, camera.position)};
    input.exposure =
        view::exposureFor(view::seenLight(session, input, render::aspectOf(options.graphics.size)));
    if (options.renderer == RendererKind::Path) {
        TERRANE_TRY(traceImage(options, **world, input, timings));
        return (*world)->finish();
    }
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

void addRendererOptions(CLI::App& command, RenderCommandOptions& options) {
    command.remove_option(command.get_option("--renderer"));
    addChoice(
        command, "--renderer", options.renderer,
        {{"quads", RendererKind::Quads}, {"rays", RendererKind::Rays}, {"path", RendererKind::Path}},
        "What finds visible surfaces: the rasterizer, or one ray for each sample; or a path tracer, which "
        "is slow and follows light over many bounces");
    PathOptions& path = options.path;
    command.remove_option(command.get_option("--samples"));
    command
        .add_option(
            "--samples", options.samples,
            "Samples of each pixel. Quads, rays: 1, 2, 4 or 8, by default the preset's. Path tracer: paths, "
            "any number, by default 64")
        ->check(numberFrom(1, 1 << 24));
    command
        .add_option("--bounces", path.bounces,
                    "Most times that light is scattered or mirrored on its way (path tracer)")
        ->check(numberFrom(0, 1 << 20))
        ->capture_default_str();
    command
        .add_option(
            "--lens", path.lens.radius,
            "Radius of the lens in blocks, which blurs what is out of focus; 0: all is sharp (path tracer)")
        ->check(numberFrom(0, 16))
        ->capture_default_str();
    command.add_option("--focus", path.lens.focus, "Distance in blocks that is in focus (path tracer)")
        ->check(numberFrom(0.1, 1e6))
        ->capture_default_str();
    command.add_flag("--denoise", path.denoises,
                     "Filter noise out of the image, which is then no truth any more (path tracer)");
    writesFile(
        command.add_option("--resume", path.samplesFile,
                           "Keep the samples in a file, and go on with those that it has (path tracer)"));
}

}  // namespace

CommandEntry addRender(CLI::App& app) {
    auto options = std::make_shared<RenderCommandOptions>();
    CLI::App* command = app.add_subcommand("render", "Draw an image into a file, without a window");
    addPlaceOptions(*command, options->place);
    command->add_option("--seconds", options->seconds, "Time of the animation of plants, water and clouds")
        ->check(numberFrom(0, 1e6))
        ->capture_default_str();
    command
        ->add_option("--frames", options->frames,
                     "Draw the image this many more times and print the median frame time")
        ->check(numberFrom(0, 100000));
    addOutputOption(*command, options->output, {".png", ".exr"},
                    "The PNG file; with --renderer path also an OpenEXR file with albedo, normal and depth");
    command->add_flag("--json", options->json, "Print timings and counts as JSON");
    addWorldOptions(*command, options->world);
    nameSceneGenerator(*command);
    addBackendOption(*command, options->backend, "Device that generates, lights and meshes");
    addGraphicsOptions(*command, options->graphics, "high");
    addRendererOptions(*command, *options);
    addWorldOption(*command, options->save,
                   "World to draw, which stays unchanged; missing chunks are generated");
    return {command, [command, options] { return renderImage(*command, *options); }};
}

}  // namespace terrane::app
