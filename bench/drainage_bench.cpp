// Drainage maps on one thread: a region, and a pass that reads a map. The label is a digest of the result: it
// changes with the result.
#include <benchmark/benchmark.h>

#include <span>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/gen/compile/program.h"
#include "terrane/gen/cpu/executor.h"
#include "terrane/gen/drainage/drainage_curves.h"
#include "terrane/gen/language/builder.h"

namespace {

using namespace terrane;

constexpr std::uint64_t kSeed = 1;

// Ranges, hills and a sea in eleven octaves, as much as a continent's heights take.
gen::Float land(gen::Pass& p) {
    const gen::Float base = p.perlin2D("land", 512, {.2f, .4f, .7f, 1.0f, .6f}) * 60.0f;
    const gen::Float range = 1.0f - abs(p.perlin2D("ranges", 512, {.3f, .5f, 1.0f})) * 1.6f;
    return 90.0f + base + max(range, 0.0f) * 60.0f + p.perlin2D("hills", 128, {3.0f, 8.0f, 16.0f});
}

// A generator of one 2D pass that reads a map with this spacing.
gen::GeneratorGraph drainedLand(int spacing, int level = 0) {
    gen::GeneratorBuilder g("drained", bench::blocks(), level);
    const auto field = g.field<gen::Float>("water");
    const gen::DrainageSpec spec = {
        .spacing = spacing, .seaLevel = 80.0f, .reach = 0.5f * static_cast<float>(spacing)};
    const gen::Drainage map = g.drainage("rivers", spec, land);
    g.pass2D("water", [&](gen::Pass& p) {
        const gen::DrainageSample s = p.drainage(map);
        p.set(field, s.distance + s.halfWidth + s.level + s.flow + s.lakeDistance + s.lakeLevel);
    });
    g.pass3D("last", [](gen::Pass&) {});
    return bench::orExit(g.finish());
}

void region(benchmark::State& state) {
    const gen::GeneratorGraph graph = drainedLand(static_cast<int>(state.range(0)));
    gen::DrainageRegion made;
    for (auto _ : state) {
        const gen::DrainageHeights heights(graph.drainages[0], kSeed);  // that knows no heights yet
        made = makeDrainageRegion(heights, {0, 0});
    }
    state.counters["segments"] = static_cast<double>(made.segments.size());
    state.counters["KiB"] = static_cast<double>(made.bytes()) / 1024;
    base::Digest digest;
    digest.update(std::as_bytes(std::span(made.segments)));
    state.SetLabel(digest.hex());
}
BENCHMARK(region)->Arg(128)->Arg(256)->Unit(benchmark::kMicrosecond);

// The pass alone over a view of 65×65 chunks of a level, the second argument; `isNew`: with the regions,
// which no one has made yet.
void viewOfChunks(benchmark::State& state, bool isNew) {
    constexpr int kSide = 65;
    const int level = static_cast<int>(state.range(1));
    const gen::GeneratorGraph graph = drainedLand(static_cast<int>(state.range(0)), level);
    const gen::Seeds seeds = gen::makeSeeds(graph, kSeed);
    const gen::Program program = compile(graph.passes[0], graph.noises);
    auto maps = std::make_unique<gen::DrainageMaps>(graph.drainages, kSeed);
    gen::ColumnValues values;
    gen::ColumnValues* const results[] = {&values};
    gen::PassInputs inputs;
    inputs.fields.resize(1);
    base::Digest digest;
    for (auto _ : state) {
        if (isNew) maps = std::make_unique<gen::DrainageMaps>(graph.drainages, kSeed);
        gen::Executor executor(graph.noises, seeds, {.drainages = maps.get()});
        digest = {};
        for (int k = 0; k < kSide * kSide; ++k) {
            inputs.chunk = {k % kSide + 100, k / kSide + 200, static_cast<std::uint8_t>(level)};
            executor.run2D(program, inputs, results);
            digest.update(std::as_bytes(std::span(values)));
        }
    }
    state.counters["time/chunk"] = benchmark::Counter(
        kSide * kSide, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.SetLabel(digest.hex());
}
BENCHMARK_CAPTURE(viewOfChunks, new, true)
    ->Args({128, 0})
    ->Args({256, 0})
    ->Args({128, 5})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(viewOfChunks, kept, false)
    ->Args({128, 0})
    ->Args({256, 0})
    ->Args({128, 3})
    ->Args({256, 5})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
