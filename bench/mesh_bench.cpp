// Meshing of whole chunks on one thread: mesh/INPUT/METHOD. The label is a digest of all quads: it
// changes where the result does.
#include <benchmark/benchmark.h>

#include <map>
#include <span>
#include <string>

#include "bench/mesh_inputs.h"
#include "terrane/base/digest.h"

namespace {

using namespace terrane;

// Made when the first benchmark needs it.
const bench::MeshWorld& worldOf(const bench::NamedInput& input) {
    static std::map<std::string, bench::MeshWorld> worlds;
    const auto found = worlds.find(input.name);
    return found != worlds.end() ? found->second : worlds.emplace(input.name, input.make()).first->second;
}

// One iteration is one chunk.
void meshChunks(benchmark::State& state, const bench::NamedInput& input, mesh::MergeMethod method) {
    const std::vector<mesh::MeshInput> inputs = worldOf(input).inputs({.method = method});
    mesh::MeshScratch scratch;
    base::Digest digest;
    std::size_t quadCount = 0;
    for (const mesh::MeshInput& chunk : inputs) {
        const mesh::ChunkMesh mesh = meshChunk(chunk, scratch);
        digest.update(std::as_bytes(std::span(mesh.quads)));
        quadCount += mesh.quads.size();
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(meshChunk(inputs[next], scratch));
        next = (next + 1) % inputs.size();
    }
    const int voxels = world::kBlocksPerLayer * inputs.front().center->heights().layers();
    state.counters["time/voxel"] = benchmark::Counter(
        voxels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["quads"] = static_cast<double>(quadCount) / static_cast<double>(inputs.size());
    state.SetLabel(digest.hex());
}

void addBenchmarks() {
    constexpr std::pair<const char*, mesh::MergeMethod> kMergeMethods[] = {
        {"greedy", mesh::MergeMethod::Greedy},
        {"none", mesh::MergeMethod::None},
        {"lines", mesh::MergeMethod::Lines},
        {"squares", mesh::MergeMethod::Squares},
        {"squares-ext", mesh::MergeMethod::SquaresExt}};
    for (const bench::NamedInput& input : bench::meshInputs()) {
        for (const auto& [name, method] : kMergeMethods) {
            const std::string full = std::string("mesh/") + input.name + '/' + name;
            benchmark::RegisterBenchmark(full.c_str(), meshChunks, input, method)
                ->Unit(benchmark::kMicrosecond);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    addBenchmarks();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
