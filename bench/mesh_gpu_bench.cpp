// Meshing of a batch of 64 chunks by both back ends, from packed sections to quads: on the GPU in the buffer
// that is drawn from, with the counts read on the way. The label is a digest of the sorted quads: the same
// for both.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "bench/bench_content.h"
#include "bench/mesh_inputs.h"
#include "terrane/base/digest.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/mesh_gpu/gpu_mesher.h"

namespace {

using namespace terrane;

constexpr std::string_view kInputs[] = {"landscape", "ocean", "cave"};

std::string digestOf(std::vector<mesh::ChunkMesh> meshes) {
    base::Digest digest;
    for (mesh::ChunkMesh& mesh : meshes) {
        std::ranges::sort(mesh.quads, {}, [](shared::Quad q) { return std::pair(q.word0, q.word1); });
        digest.update(std::as_bytes(std::span(mesh.quads)));
    }
    return digest.hex();
}

void countChunks(benchmark::State& state, std::size_t chunks) {
    state.counters["time/chunk"] =
        benchmark::Counter(static_cast<double>(chunks),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void onCpu(benchmark::State& state, const bench::MeshWorld& world) {
    const std::vector<mesh::MeshInput> inputs = world.inputs({});
    const auto mesher = mesh::makeCpuMesher();
    for (auto _ : state) benchmark::DoNotOptimize(mesher->mesh(inputs));
    countChunks(state, inputs.size());
    state.SetLabel(digestOf(mesher->mesh(inputs)));
}

mesh_gpu::GpuMesher gpuMesher(const world::BlockRegistry& blocks) {
    static const auto context = bench::orExit(gpu::HeadlessContext::create({}));
    static const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    return bench::orExit(mesh_gpu::GpuMesher::create(shaders, blocks));
}

void onGpu(benchmark::State& state, const bench::MeshWorld& world) {
    const std::vector<mesh::MeshInput> inputs = world.inputs({});
    mesh_gpu::GpuMesher mesher = gpuMesher(*inputs.front().blocks);
    const gpu::Buffer quads(std::size_t{64} << 20, 0, "quads");
    for (auto _ : state) {
        mesher.count(inputs);
        std::vector<std::uint32_t> firstQuads;
        std::uint32_t total = 0;
        for (const mesh::MeshSection& meshSection : mesher.meshSections().all) {
            firstQuads.push_back(total);
            total += mesh::quadCount(meshSection);
        }
        mesher.write(firstQuads, quads);
        glFinish();
    }
    countChunks(state, inputs.size());
    mesh_gpu::GpuBatchMesher readsBack(gpuMesher(*inputs.front().blocks));
    state.SetLabel(digestOf(readsBack.mesh(inputs)));
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<bench::MeshWorld> worlds;
    worlds.reserve(std::size(kInputs));
    for (const bench::NamedInput& input : bench::meshInputs()) {
        if (std::ranges::find(kInputs, input.name) == std::end(kInputs)) continue;
        const bench::MeshWorld* world = &worlds.emplace_back(input.make());
        for (const auto& [backend, run] : {std::pair("cpu/", &onCpu), std::pair("gpu/", &onGpu)}) {
            benchmark::RegisterBenchmark((std::string(backend) + input.name).c_str(),
                                         [world, run = run](benchmark::State& state) { run(state, *world); })
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime()
                ->MeasureProcessCPUTime();  // of the threads that stand for a GPU too
        }
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
