// terrane fly: straight ahead at full speed without a window, in real time, and what each frame took. For
// plots of frame times (tools/flight_trace.sh): loading is done as the window does it.
#include <fmt/ostream.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/content.h"
#include "apps/terrane/options.h"
#include "apps/terrane/resource_pack.h"
#include "apps/terrane/window/player.h"
#include "apps/terrane/world_view.h"
#include "terrane/base/log.h"
#include "terrane/gpu/context.h"

namespace terrane::app {
namespace {

using Clock = std::chrono::steady_clock;

struct FlyOptions {
    WorldOptions world;
    SaveOptions save;
    GraphicsOptions graphics;
    std::vector<double> at = {8, 8, 120}, look = {45, 0};
    double seconds = 20;
    std::string output;
};

// Milliseconds, and what they were spent on. Of loading the processor time of this thread, too: where other
// programs use the machine as well, any part of a frame may have to wait for them.
struct Frame {
    double seconds = 0;  // since the start
    double all = 0, follow = 0, upload = 0, draw = 0, followProcessor = 0, uploadProcessor = 0;
    std::size_t uploads = 0, visible = 0, wanted = 0, queued = 0;
};

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double processorMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) / 1e6;
}

struct Flight {
    WorldSession& session;
    render::Renderer& renderer;
    WorldView view;
    int viewDistance;
    Player player;
};

// glFinish() after each part: what the GPU does for it counts there.
Frame flyFrame(Flight& flight, double sinceStart, double seconds) {
    Frame frame;
    frame.seconds = sinceStart;
    const auto start = Clock::now();
    const double processorStart = processorMilliseconds();
    flight.player.move(flight.session.world, flight.session.blocks, {.forward = true}, seconds);
    flight.view.follow(flight.player.camera(), flight.viewDistance);
    frame.follow = millisecondsSince(start);
    frame.followProcessor = processorMilliseconds() - processorStart;

    const auto uploadStart = Clock::now();
    frame.uploads = flight.view.upload(uploadBudget(seconds));
    glFinish();
    frame.upload = millisecondsSince(uploadStart);
    frame.uploadProcessor = processorMilliseconds() - processorStart - frame.followProcessor;

    const auto drawStart = Clock::now();
    render::FrameInput input;
    input.camera = flight.player.camera();
    input.environment = world::environmentAt(0.4f);
    input.fogDistance = fogDistance(flight.viewDistance);
    flight.renderer.draw(input);
    glFinish();
    frame.draw = millisecondsSince(drawStart);
    frame.all = millisecondsSince(start);
    const stream::Progress progress = flight.session.pipeline->progress();
    frame.visible = progress.visible;
    frame.wanted = progress.wanted;
    frame.queued = flight.session.pipeline->queuedCount();
    return frame;
}

// A flight starts in a world that is there: until then the camera stands.
void waitForWorld(Flight& flight) {
    stream::ChunkPipeline& pipeline = *flight.session.pipeline;
    for (;;) {
        flight.view.follow(flight.player.camera(), flight.viewDistance);
        flight.view.upload(1);
        if (pipeline.progress().complete()) break;
        pipeline.waitForWorkers(std::chrono::milliseconds(20));
    }
    while (flight.view.upload(1) > 0) continue;
    for (int k = 0; k < 3; ++k) flyFrame(flight, 0, 0);  // shaders are compiled now
}

std::vector<Frame> fly(Flight& flight, double seconds) {
    std::vector<Frame> frames;
    const auto start = Clock::now();
    auto last = start;
    for (double now = 0; now < seconds;) {
        const auto time = Clock::now();
        now = std::chrono::duration<double>(time - start).count();
        frames.push_back(flyFrame(flight, now, std::chrono::duration<double>(time - last).count()));
        last = time;
    }
    return frames;
}

base::Result<void> writeFrames(const std::string& file, const std::vector<Frame>& frames) {
    std::ofstream out(file);
    out << "time_s,frame_ms,follow_ms,upload_ms,draw_ms,follow_processor_ms,upload_processor_ms,uploads,"
           "visible_chunks,wanted_"
           "chunks,queued_chunks\n";
    for (const Frame& f : frames) {
        fmt::print(out, "{:.4f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{},{}\n", f.seconds, f.all,
                   f.follow, f.upload, f.draw, f.followProcessor, f.uploadProcessor, f.uploads, f.visible,
                   f.wanted, f.queued);
    }
    out.close();
    return out ? base::Result<void>() : base::fail("{}: cannot be written", file);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void report(const std::vector<Frame>& frames, const Player& player) {
    std::vector<double> all;
    double longest = 0, loading = 0;
    for (const Frame& f : frames) {
        all.push_back(f.all);
        longest = std::max(longest, f.all);
        loading = std::max(loading, f.followProcessor + f.uploadProcessor);
    }
    const double middle = median(all);
    // Long frames, and those of them that would not be without the time that loading took or waited.
    std::size_t slow = 0, byWaiting = 0, byLoading = 0;
    for (const Frame& f : frames) {
        if (f.all <= 2 * middle) continue;
        ++slow;
        if (f.all - f.follow - f.upload <= 2 * middle) ++byWaiting;
        if (f.all - f.followProcessor - f.uploadProcessor <= 2 * middle) ++byLoading;
    }
    const glm::dvec3& p = player.camera().position;
    base::logInfo(
        "{} frames to {:.0f},{:.0f},{:.0f}: median {:.1f} ms, longest {:.1f} ms; loading: at most {:.2f} ms "
        "of the processor",
        frames.size(), p.x, p.y, p.z, middle, longest, loading);
    base::logInfo(
        "{} frames over twice the median; without the time in loading {} would not be, without its processor "
        "time {}",
        slow, byWaiting, byLoading);
}

base::Result<void> flyAndTell(const FlyOptions& options, const CLI::App& command) {
    const render::Camera camera{{options.at[0], options.at[1], options.at[2]},
                                static_cast<float>(options.look[0]),
                                static_cast<float>(std::clamp(options.look[1], -90.0, 90.0))};
    if (!world::isInWorld(render::cameraChunk(camera))) return base::fail("--at: outside the world");
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
    renderer->setViewDistance(options.graphics.viewDistance);
    (*session)->pipeline->setMeshOptions(options.graphics.mesh);

    Flight flight{**session, *renderer, WorldView(**session, *renderer), options.graphics.viewDistance,
                  Player(camera, Movement::Fast)};
    waitForWorld(flight);
    const std::vector<Frame> frames = fly(flight, options.seconds);
    if (auto written = writeFrames(options.output, frames); !written) return written;
    if (auto saved = (*session)->save(); !saved) return saved;
    if (context->debugErrorCount() > 0) return base::fail("the graphics driver reported errors, see above");
    report(frames, flight.player);
    return {};
}

}  // namespace

CommandEntry addFly(CLI::App& app) {
    auto options = std::make_shared<FlyOptions>();
    CLI::App* command =
        app.add_subcommand("fly", "Fly straight ahead without a window and write what each frame took");
    command
        ->add_option_function<std::string>(
            "--at",
            [options](const std::string& text) {
                options->at = parseNumbers(text, 3, "--at: expected X,Y,Z in blocks");
            },
            "Where the flight begins")
        ->type_name("X,Y,Z")
        ->default_str("8,8,120");
    command
        ->add_option_function<std::string>(
            "--look",
            [options](const std::string& text) {
                options->look = parseNumbers(text, 2, "--look: expected YAW,PITCH in degrees");
            },
            "Where it goes; yaw 0 is along x, 90 along y")
        ->type_name("YAW,PITCH")
        ->default_str("45,0");
    command->add_option("--for", options->seconds, "Seconds")
        ->check(numberFrom(0.1, 600))
        ->capture_default_str();
    addOutputOption(*command, options->output, "The CSV file, a line a frame");
    addWorldOptions(*command, options->world);
    addGraphicsOptions(*command, options->graphics, "auto");
    addSaveGameOptions(*command, options->save);
    return {command, [options, command] { return flyAndTell(*options, *command); }};
}

}  // namespace terrane::app
