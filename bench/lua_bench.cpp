// Generators written in Lua beside the same ones in C++: chunks a second on one thread, measured in turn, and
// how long a script takes to record. The label is a digest of what was made, which is the same for both.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/base/files.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/lua/script.h"
#include "tests/support/default_heights.h"

namespace {

using namespace terrane;

lua::Script scriptOf(const std::string& name) {
    const std::string file = name + ".lua";
    return {bench::orExit(base::readFile(TERRANE_SOURCE_DIR "/examples/lua/generators/" + file)), file};
}

gen::GeneratorGraph graphOf(const std::string& name, bool isScript) {
    if (!isScript) return bench::orExit(gen::makeGenerator(name, bench::blocks()));
    return bench::orExit(lua::recordScript(scriptOf(name), {name, ""}, bench::blocks()));
}

// An iteration makes 12×12 chunks with a new generator.
void generate(benchmark::State& state, const std::string& name, bool isScript) {
    constexpr int kSide = 12;
    std::string digest;
    for (auto _ : state) {
        state.PauseTiming();
        const gen::Generator generator(graphOf(name, isScript), 1);
        base::Digest made;
        state.ResumeTiming();
        for (int k = 0; k < kSide * kSide; ++k) {
            const world::Chunk chunk = generator.generate({k % kSide, k / kSide});
            state.PauseTiming();
            std::array<world::Section::Value, world::kBlocksPerSection> values;
            for (int s = 0; s < world::kSectionsPerChunk; ++s) {
                chunk.section(s).unpack(values);
                made.update(std::as_bytes(std::span(values)));
            }
            state.ResumeTiming();
        }
        digest = made.hex();
    }
    state.counters["chunks_per_second"] =
        benchmark::Counter(kSide * kSide, benchmark::Counter::kIsIterationInvariantRate);
    state.SetLabel(digest);
}

void record(benchmark::State& state, const std::string& name) {
    const lua::Script script = scriptOf(name);
    for (auto _ : state) {
        auto graph = bench::orExit(
            lua::recordScript(script, {name, ""}, bench::blocks(), {static_cast<int>(state.range(0)), {}}));
        benchmark::DoNotOptimize(graph);
    }
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    for (const std::string name : {"hills3d", "voronoi"}) {
        for (const bool isScript : {false, true}) {
            const std::string full = "generate/" + name + (isScript ? "/lua" : "/cpp");
            benchmark::RegisterBenchmark(full.c_str(), [=](benchmark::State& state) {
                generate(state, name, isScript);
            })->Unit(benchmark::kMillisecond);
        }
    }
    for (const std::string name : {"01_flat", "hills3d", "08_forest"}) {
        benchmark::RegisterBenchmark(("record/" + name).c_str(),
                                     [=](benchmark::State& state) { record(state, name); })
            ->Arg(0)
            ->Arg(5)
            ->Unit(benchmark::kMicrosecond);
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
