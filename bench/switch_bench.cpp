// The cost of switching a graphics option while playing. Each option goes through its values from the preset
// "medium" and back; its shaders are compiled in the background first. Counters are milliseconds, the maximum
// over the values: wait_ms until the option is there, then stall_ms from the call to the end of the first
// frame with it, less a later frame.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "bench/bench_content.h"
#include "terrane/content/built_in.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/frame/background_compiler.h"
#include "terrane/render/frame/graphics_table.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/view/camera_path.h"

namespace {

using namespace terrane;

constexpr int kViewDistance = 4;
constexpr glm::ivec2 kSize{320, 180};
constexpr int kSteadyFrames = 3;

void load(render::Renderer& renderer, const render::Camera& camera) {
    const gen::Generator generator(bench::orExit(gen::makeGenerator("overworld", bench::blocks())), 1);
    world::World world;
    base::JobSystem jobs(std::max(1u, std::thread::hardware_concurrency()));
    const light::LightTable lights(bench::blocks());
    stream::ChunkPipeline pipeline(
        {jobs, bench::blocks(), lights, world, {&generator, nullptr, false}, nullptr});
    pipeline.setView(render::cameraChunk(camera), kViewDistance);
    for (pipeline.update(); !pipeline.progress().complete(); pipeline.update()) {
        pipeline.waitForWorkers(std::chrono::milliseconds(100));
    }
    for (const stream::ChunkChange& change : pipeline.takeChanges(std::numeric_limits<std::size_t>::max())) {
        if (change.mesh) renderer.setChunk(change.pos, *change.mesh, change.meshSections);
        if (change.light) renderer.setLight(change.pos, *change.light);
    }
}

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

class Stage {
  public:
    Stage() : renderer_(makeRenderer()) { load(renderer_, camera_); }

    // Milliseconds until the shaders for these options are compiled.
    double waitFor(const render::RenderOptions& options) {
        const auto start = Clock::now();
        while (!compiler_.isReady(kSize, options, {renderer_.hasTint(), renderer_.hasLand()}))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return millisecondsSince(start);
    }

    // Milliseconds that the frame with these options takes longer than those after it; 0 where the driver
    // has not so many samples.
    double stallOf(const render::RenderOptions& options) {
        const auto start = Clock::now();
        if (!renderer_.configure(kSize, options)) return 0;
        const double first = drawSince(start);
        std::vector<double> steady;
        for (int k = 0; k < kSteadyFrames; ++k) steady.push_back(drawSince(Clock::now()));
        std::ranges::nth_element(steady, steady.begin() + kSteadyFrames / 2);
        return first - steady[kSteadyFrames / 2];
    }

  private:
    render::Renderer makeRenderer() {
        return bench::orExit(render::Renderer::create(shaders_, bench::blocks(), content::builtInTextures(),
                                                      gpu::queryDevice()));
    }
    double drawSince(Clock::time_point start) {
        renderer_.draw({camera_, world::environmentAt(0.34f), 16.0f * kViewDistance, 0, render::View::Color});
        glFinish();
        return millisecondsSince(start);
    }

    gpu::HeadlessContext context_ = bench::orExit(gpu::HeadlessContext::create({}));
    gpu::ShaderLoader shaders_ = gpu::builtInShaders("");
    render::Camera camera_ = view::cameraOf(content::findScene("landscape")->pose);
    render::Renderer renderer_;
    render::BackgroundCompiler compiler_{shaders_, bench::blocks(), content::builtInTextures()};
};

void switchThrough(benchmark::State& state, const render::GraphicsRow& row) {
    static Stage stage;
    const render::RenderOptions usual = render::findPreset("medium", false)->options;
    stage.stallOf(usual);
    double wait = 0, stall = 0;
    for (auto _ : state) {
        for (int word = 0; word < static_cast<int>(row.valueNames.size()); ++word) {
            render::GraphicsSettings settings{.render = usual, .mesh = {}};
            row.set(settings, word);
            if (settings.render == usual) continue;  // unchanged, or an option of meshes
            wait = std::max(wait, stage.waitFor(settings.render));
            stall = std::max({stall, stage.stallOf(settings.render), stage.stallOf(usual)});
        }
    }
    state.counters["wait_ms"] = wait;
    state.counters["stall_ms"] = stall;
}

}  // namespace

int main(int argc, char** argv) {
    for (const render::GraphicsRow& row : render::graphicsTable()) {
        benchmark::RegisterBenchmark(std::string("switch/").append(row.name).c_str(),
                                     [&row](benchmark::State& state) { switchThrough(state, row); })
            ->Iterations(1);
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
