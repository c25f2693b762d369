// Light of whole areas by both back ends, over the landscape scene with a view distance of 16, and of its
// chunks in batches as streaming asks for them. The label is a digest of the light: the same for both.
#include <benchmark/benchmark.h>

#include "bench/scene_chunks.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light_gpu/gpu_batch_lighter.h"

namespace {

using namespace terrane;

const light::LightTable& table() {
    static const light::LightTable result(bench::blocks());
    return result;
}

void solve(benchmark::State& state, light::AreaSolver& solver, std::string_view scene) {
    const std::vector<world::Chunk> chunks = bench::sceneChunks(scene);
    light::LightArea area{bench::kSide, bench::kSide, {}};
    for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
    std::vector<light::ChunkLight> lights;
    for (auto _ : state) lights = solver.solve(area);
    state.counters["time/chunk"] =
        benchmark::Counter(static_cast<double>(chunks.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.SetLabel(bench::digestOf(lights));
}

void onCpu(benchmark::State& state, std::string_view scene) {
    solve(state, *light::makeCpuSolver(table()), scene);
}

void onGpu(benchmark::State& state, std::string_view scene) {
    static const auto context = bench::orExit(gpu::HeadlessContext::create({}));
    static const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    auto solver = bench::orExit(light_gpu::GpuLightSolver::create(shaders, table()));
    solve(state, solver, scene);
}

// Squares of `side` × `side` chunks, of which those around are known.
void lightBatches(benchmark::State& state, light::BatchLighter& lighter) {
    const std::vector<world::Chunk> chunks = bench::sceneChunks("landscape");
    light::LightArea area{bench::kSide, bench::kSide, {}};
    for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
    const auto side = static_cast<int>(state.range(0));
    std::vector<light::LightRequest> requests;
    for (int k = 0; k < side * side; ++k)
        requests.push_back(light::requestIn(area, 8 + k % side, 8 + k / side));
    std::vector<light::ChunkLight> lights;
    for (auto _ : state) lights = light::lightAll(lighter, requests);
    state.counters["time/chunk"] =
        benchmark::Counter(static_cast<double>(requests.size()),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.SetLabel(bench::digestOf(lights));
}

void batchesOnCpu(benchmark::State& state) {
    lightBatches(state, *light::makeCpuLighter(table()));
}

void batchesOnGpu(benchmark::State& state) {
    static const auto context = bench::orExit(gpu::HeadlessContext::create({}));
    static const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    auto lighter = bench::orExit(light_gpu::GpuBatchLighter::create(shaders, table()));
    lightBatches(state, lighter);
}

BENCHMARK(batchesOnCpu)->Arg(8)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(batchesOnGpu)->Arg(4)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(onCpu, landscape, "landscape")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(onGpu, landscape, "landscape")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(onCpu, cave, "cave")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(onGpu, cave, "cave")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
