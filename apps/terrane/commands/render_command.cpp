// terrane render: one picture of one place, without a window.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/chunk_uploads.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/content.h"
#include "apps/terrane/scenes.h"
#include "apps/terrane/world_session.h"
#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/gpu/context.h"

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
    std::string output;
    bool json = false;
};

// Of the whole process so far.
std::size_t peakMemoryBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

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

// Generates and meshes everything in view; returns when the renderer has it.
void loadAll(WorldSession& session, ChunkUploads& uploads, const render::Camera& camera, int viewDistance) {
    session.pipeline->setView(render::cameraChunk(camera), viewDistance);
    for (;;) {
        session.pipeline->update();
        uploads.update(std::numeric_limits<std::size_t>::max());
        const bool isLoaded = session.pipeline->progress().complete();
        if (isLoaded && uploads.isIdle()) return;
        if (!isLoaded) session.pipeline->waitForWorkers(std::chrono::milliseconds(100));
    }
}

// Milliseconds of each frame; the picture stays the same.
std::vector<double> drawFrames(render::Renderer& renderer, const render::FrameInput& input, int count) {
    std::vector<double> frames;
    for (int k = 0; k < count; ++k) {
        const auto start = Clock::now();
        renderer.draw(input);
        glFinish();
        frames.push_back(millisecondsSince(start));
    }
    return frames;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// GPU milliseconds of the passes of a frame, by name.
nlohmann::json passTimes(const render::Renderer& renderer) {
    nlohmann::json times = nlohmann::json::object();
    for (const gpu::GpuTiming& pass : renderer.passTimes()) times[pass.name] = pass.milliseconds;
    return times;
}

base::Result<void> renderPicture(const PictureOptions& options, const CLI::App& command) {
    const auto start = Clock::now();
    auto scene = chosenScene(options);
    if (!scene) return tl::unexpected(scene.error());
    auto session = WorldSession::create(options.world, options.save, command);
    if (!session) return tl::unexpected(session.error());
    auto context = gpu::HeadlessContext::create({.debug = options.graphics.debugGl});
    if (!context) return tl::unexpected(context.error());
    const gpu::ShaderLoader shaders = makeShaderLoader(options.graphics.shaderRoot);
    const gpu::DeviceInfo device = gpu::queryDevice();
    auto renderer = render::Renderer::create(shaders, (*session)->blocks, builtInTextures(), device);
    if (!renderer) return tl::unexpected(renderer.error());
    const auto graphics = renderOptions(options.graphics.choices, device.software);
    if (auto configured = renderer->configure(options.graphics.size, graphics); !configured)
        return configured;
    const double setUp = millisecondsSince(start);

    const auto loadStart = Clock::now();
    (*session)->pipeline->setMeshOptions(options.graphics.mesh);
    renderer->setViewDistance(options.graphics.viewDistance);
    auto uploads =
        ChunkUploads::create(options.backend, 0, (*session)->blocks, *(*session)->pipeline, *renderer);
    if (!uploads) return tl::unexpected(uploads.error());
    loadAll(**session, *uploads, scene->camera, options.graphics.viewDistance);
    const double load = millisecondsSince(loadStart);

    const auto drawStart = Clock::now();
    const render::FrameInput input{scene->camera,
                                   world::environmentAt(scene->timeDay),
                                   fogDistance(options.graphics.viewDistance),
                                   options.seconds,
                                   options.graphics.view,
                                   isUnderWater(**session, scene->camera)};
    renderer->draw(input);
    const base::Image image = renderer->readImage();
    const double draw = millisecondsSince(drawStart);
    const std::vector<double> frames = drawFrames(*renderer, input, options.frames);
    if (auto written = base::writePng(options.output, image); !written) return written;
    if (auto saved = (*session)->save(); !saved) return saved;
    if (context->debugErrorCount() > 0) return base::fail("the graphics driver reported errors, see above");

    const render::FrameStatistics statistics = renderer->statistics();
    const std::size_t chunks = (*session)->world.chunks().size();
    base::logInfo("{}: {} chunks in {:.1f} s, {} quads in {} regions", options.output, chunks, load / 1000,
                  statistics.quads, statistics.regions);
    if (!frames.empty()) {
        base::logInfo("a frame takes {:.1f} ms in the middle of {}, {:.1f} frames/s", median(frames),
                      frames.size(), 1000 / median(frames));
    }
    if (options.json) {
        nlohmann::json result = {
            {"file", options.output},
            {"milliseconds",
             {{"set_up", setUp}, {"load", load}, {"draw", draw}, {"all", millisecondsSince(start)}}},
            {"chunks", chunks},
            {"quads", statistics.quads},
            {"regions", statistics.regions},
            {"draw_commands", statistics.drawCommands},
            {"triangles",
             {{"opaque", statistics.opaqueTriangles},
              {"transparent", statistics.transparentTriangles},
              {"shadow", renderer->shadowTriangles(input)}}},
            {"bytes",
             {{"blocks", (*session)->world.memoryBytes()},
              {"light", (*session)->pipeline->lightBytes()},
              {"light_of_stage_1", (*session)->pipeline->localLightBytes()},
              {"generator_cache", (*session)->generator->cacheBytes()},
              {"light_gpu", renderer->lightBytes()},
              {"quads_gpu", renderer->quadBytes()},
              {"process_peak", peakMemoryBytes()}}}};
        if (!frames.empty()) {
            result["milliseconds"]["frame"] = median(frames);
            result["passes"] = passTimes(*renderer);
        }
        std::cout << result.dump() << '\n';
    }
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
    addOutputOption(*command, options->output, "The PNG file");
    command->add_flag("--json", options->json, "Print timings and counts as JSON");
    addWorldOptions(*command, options->world);
    addBackendOption(*command, options->backend, "Where to make meshes");
    addGraphicsOptions(*command, options->graphics, "high");
    addSaveGameOptions(*command, options->save);
    return {command, [options, command] { return renderPicture(*options, *command); }};
}

}  // namespace terrane::app
