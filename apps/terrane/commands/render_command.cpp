// terrane render: one picture of one place, without a window.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/backend.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/content.h"
#include "apps/terrane/flight.h"
#include "apps/terrane/frame_times.h"
#include "apps/terrane/options.h"
#include "apps/terrane/process_figures.h"
#include "apps/terrane/resource_pack.h"
#include "apps/terrane/scenes.h"
#include "apps/terrane/world_view.h"
#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/gpu/context.h"
#include "terrane/store/save_path.h"

namespace terrane::app {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct PictureOptions {
    WorldOptions world;
    SaveOptions save;
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    std::string scene;
    std::optional<std::vector<double>> at, look;
    std::optional<float> time;
    float seconds = 0;
    int frames = 0;
    double flight = 0;  // seconds
    std::string output;
    bool json = false;
};

base::Result<Scene> chosenScene(const PictureOptions& options) {
    Scene scene = scenes().front();
    if (!options.scene.empty()) {
        const Scene* found = findScene(options.scene);
        if (!found)
            return base::fail("unknown scene \"{}\": ocean, desert, landscape or cave", options.scene);
        scene = *found;
    } else if (!options.at) {
        return base::fail("render needs --scene or --at");
    }
    if (options.at) scene.camera = {{(*options.at)[0], (*options.at)[1], (*options.at)[2]}, 0, 0};
    if (options.look) {
        scene.camera.yaw = static_cast<float>((*options.look)[0]);
        scene.camera.pitch = static_cast<float>(std::clamp((*options.look)[1], -90.0, 90.0));
    }
    if (options.time) scene.timeDay = *options.time;
    if (!world::isInWorld(render::cameraChunk(scene.camera))) return base::fail("--at: outside the world");
    return scene;
}

// What drawing a picture took; milliseconds.
struct PictureFigures {
    double setUp = 0, load = 0, upload = 0, draw = 0, all = 0;
    FrameTimes frames;
    std::optional<FlightLog> flight;
};

Flight flightOf(const PictureOptions& options, const Scene& scene) {
    return {scene.camera, options.flight, options.graphics.viewDistance, scene.timeDay};
}

void tell(const PictureOptions& options, const PictureFigures& figures, const WorldSession& session,
          const render::FrameStatistics& statistics) {
    base::logInfo("{}: {} chunks in {:.1f} s, {} quads in {} regions", options.output,
                  session.world.chunks().size(), figures.load / 1000, statistics.quads, statistics.regions);
    if (figures.frames.milliseconds.empty()) return;
    const double frame = medianOf(figures.frames);
    base::logInfo("a frame takes {:.1f} ms in the middle of {}, {:.1f} frames/s", frame,
                  figures.frames.milliseconds.size(), 1000 / frame);
}

// Of the save's file and of what SQLite has not moved into it yet; 0 without a save.
std::uintmax_t saveBytes(const SaveOptions& save) {
    const auto path = store::savePath(save.name, store::savePlaces());
    if (save.name.empty() || !path) return 0;
    std::uintmax_t bytes = 0;
    for (const char* ending : {"", "-wal"}) {
        std::error_code error;
        const std::uintmax_t size = std::filesystem::file_size(path->string() + ending, error);
        if (!error) bytes += size;
    }
    return bytes;
}

// Triangles of the shadow map at times of day from 0 to 1.
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

nlohmann::json memoryJson(const PictureOptions& options, const WorldSession& session,
                          const render::Renderer& renderer) {
    return {{"blocks", session.world.memoryBytes()},
            {"light", session.pipeline->lightBytes()},
            {"light_of_stage_1", session.pipeline->localLightBytes()},
            {"generator_cache", session.generator->cacheBytes()},
            {"light_gpu", renderer.lightBytes()},
            {"quads_gpu", renderer.quadBytes()},
            {"save", saveBytes(options.save)},
            {"process", residentBytes()},
            {"process_peak", peakResidentBytes()}};
}

nlohmann::json tasksJson(const WorldSession& session) {
    nlohmann::json tasks = nlohmann::json::object();
    for (const stream::TaskTime& task : session.pipeline->taskTimes())
        tasks[task.name] = {{"count", task.count}, {"milliseconds", task.microseconds / 1000}};
    return tasks;
}

nlohmann::json pictureJson(const PictureOptions& options, const PictureFigures& figures,
                           const WorldSession& session, render::Renderer& renderer,
                           const render::FrameInput& input) {
    const render::FrameStatistics statistics = renderer.statistics();
    nlohmann::json result = {{"file", options.output},
                             {"milliseconds",
                              {{"set_up", figures.setUp},
                               {"load", figures.load},
                               {"upload", figures.upload},
                               {"draw", figures.draw},
                               {"all", figures.all}}},
                             {"tasks", tasksJson(session)},
                             {"chunks", session.world.chunks().size()},
                             {"chunks_in_view", session.pipeline->progress().wanted},
                             {"quads", statistics.quads},
                             {"regions", statistics.regions},
                             {"draw_commands", statistics.drawCommands},
                             {"triangles",
                              {{"opaque", statistics.opaqueTriangles},
                               {"transparent", statistics.transparentTriangles},
                               {"shadow", renderer.shadowTriangles(input)}}},
                             {"shadow_triangles_over_the_day", shadowsOverTheDay(renderer, input)},
                             {"bytes", memoryJson(options, session, renderer)}};
    if (!figures.frames.milliseconds.empty()) {
        result["milliseconds"]["frame"] = medianOf(figures.frames);
        result["milliseconds"]["frame_processor"] = figures.frames.processorMilliseconds;
        result["passes"] = passMedians(figures.frames);
    }
    if (figures.flight) result["flight"] = jsonOf(*figures.flight);
    return result;
}

base::Result<void> renderPicture(const PictureOptions& options, const CLI::App& command) {
    const auto start = Clock::now();
    auto scene = chosenScene(options);
    if (!scene) return tl::unexpected(scene.error());
    auto session = WorldSession::create(options.world, options.save, command);
    if (!session) return tl::unexpected(session.error());
    auto textures = loadTextures(options.graphics.resourcePack, (*session)->blocks);
    if (!textures) return tl::unexpected(textures.error());
    auto context = gpu::HeadlessContext::create({.debug = options.graphics.debugGl});
    if (!context) return tl::unexpected(context.error());
    const gpu::ShaderLoader shaders = makeShaderLoader(options.graphics.shaderRoot);
    const gpu::DeviceInfo device = gpu::queryDevice();
    auto renderer = render::Renderer::create(shaders, (*session)->blocks, *textures, device);
    if (!renderer) return tl::unexpected(renderer.error());
    const auto graphics = renderOptions(options.graphics.choices, device.software);
    if (auto configured = renderer->configure(options.graphics.size, graphics); !configured)
        return configured;
    const double setUp = millisecondsSince(start);

    const auto loadStart = Clock::now();
    (*session)->pipeline->setMeshOptions(options.graphics.mesh);
    renderer->setViewDistance(options.graphics.viewDistance);
    WorldView view(**session, *renderer);
    if (usesGpu(options.backend)) {
        if (auto meshes = view.meshOnGpu(WorldView::kNoHurry); !meshes) return meshes;
    }
    PictureFigures figures;
    figures.setUp = setUp;
    if (options.flight > 0) {
        figures.flight = fly(**session, *renderer, view, flightOf(options, *scene));
        scene->camera = figures.flight->camera;
    }
    figures.upload = loadAll(**session, view, scene->camera, options.graphics.viewDistance, loadStart);
    figures.load = millisecondsSince(loadStart);

    const auto drawStart = Clock::now();
    const render::FrameInput input{scene->camera,
                                   world::environmentAt(scene->timeDay),
                                   fogDistance(options.graphics.viewDistance),
                                   options.seconds,
                                   options.graphics.view,
                                   isUnderWater(**session, scene->camera)};
    renderer->draw(input);
    const base::Image image = renderer->readImage();
    figures.draw = millisecondsSince(drawStart);
    figures.frames = measureFrames(*renderer, input, options.frames);
    if (auto written = base::writePng(options.output, image); !written) return written;
    if (auto saved = (*session)->save(); !saved) return saved;
    if (context->debugErrorCount() > 0) return base::fail("the graphics driver reported errors, see above");

    figures.all = millisecondsSince(start);
    tell(options, figures, **session, renderer->statistics());
    if (options.json) std::cout << pictureJson(options, figures, **session, *renderer, input).dump() << '\n';
    return {};
}

std::string sceneNames() {
    std::string names;
    for (const Scene& scene : scenes()) names += (names.empty() ? "" : ", ") + std::string(scene.name);
    return names;
}

}  // namespace

CommandEntry addRender(CLI::App& app) {
    auto options = std::make_shared<PictureOptions>();
    CLI::App* command = app.add_subcommand("render", "Draw a picture into a PNG file, without a window");
    auto* scene = command->add_option("--scene", options->scene, "A reference scene: " + sceneNames());
    command
        ->add_option_function<std::string>(
            "--at",
            [options](const std::string& text) {
                options->at = parseNumbers(text, 3, "--at: expected X,Y,Z in blocks");
            },
            "Camera position")
        ->type_name("X,Y,Z")
        ->excludes(scene);
    command
        ->add_option_function<std::string>(
            "--look",
            [options](const std::string& text) {
                options->look = parseNumbers(text, 2, "--look: expected YAW,PITCH in degrees");
            },
            "Camera direction; yaw 0 looks along x, 90 along y")
        ->type_name("YAW,PITCH");
    command->add_option("--time", options->time, "Time of day: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk")
        ->check(numberFrom(0, 1));
    command->add_option("--seconds", options->seconds, "Time for what moves: plants, water, clouds")
        ->check(numberFrom(0, 1e6))
        ->capture_default_str();
    command
        ->add_option("--frames", options->frames,
                     "Draws the picture so often again and tells how long that takes")
        ->check(numberFrom(0, 100000));
    command
        ->add_option(
            "--flight", options->flight,
            "Flies ahead so many seconds before, drawing as the window does; --json tells how that went")
        ->check(numberFrom(0, 3600));
    addOutputOption(*command, options->output, "The PNG file");
    command->add_flag("--json", options->json, "Print timings and counts as JSON");
    addWorldOptions(*command, options->world);
    addBackendOption(*command, options->backend, "Where to make meshes");
    addGraphicsOptions(*command, options->graphics, "high");
    addSaveGameOptions(*command, options->save);
    return {command, [options, command] { return renderPicture(*options, *command); }};
}

}  // namespace terrane::app
