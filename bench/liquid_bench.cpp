// Water that flows: a dam is broken above a valley of 64×64 blocks. One iteration is a whole flood, until it
// has settled. `median_ms` and `max_ms` are of its ticks; the digest is of the settled world.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "bench/bench_content.h"
#include "tests/world/dam.h"

namespace {

using namespace terrane;

world::World makeWorld() {
    world::World dam;
    for (const world::ChunkPos pos : world::damChunks())
        dam.insert(pos, world::damChunk(pos, bench::blocks()));
    return dam;
}

struct Flood {
    std::vector<double> tickMs;
    std::size_t cells = 0, mostCells = 0;
};

Flood flood(world::World& dam) {
    Flood result;
    std::vector<world::BlockEdit> edits;
    world::breakDam(dam, bench::blocks(), edits);
    while (result.tickMs.size() < 1000) {
        edits.clear();
        const auto begin = std::chrono::steady_clock::now();
        const std::size_t cells = world::flowLiquids(dam, bench::blocks(), world::kDamArea, edits);
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
        if (cells == 0) break;
        result.tickMs.push_back(spent.count());
        result.cells += cells;
        result.mostCells = std::max(result.mostCells, cells);
    }
    return result;
}

void breakDam(benchmark::State& state) {
    std::vector<double> times;
    Flood last;
    for (auto _ : state) {
        state.PauseTiming();
        world::World dam = makeWorld();
        state.ResumeTiming();
        last = flood(dam);
        state.PauseTiming();
        times.insert(times.end(), last.tickMs.begin(), last.tickMs.end());
        state.SetLabel(world::damDigest(dam));
        state.ResumeTiming();
    }
    std::ranges::sort(times);
    state.counters["ticks"] = static_cast<double>(last.tickMs.size());
    state.counters["most_cells"] = static_cast<double>(last.mostCells);
    state.counters["median_ms"] = times[times.size() / 2];
    state.counters["max_ms"] = times.back();
}

// A tick where nothing flows, over 17×17 chunks.
void nothingFlows(benchmark::State& state) {
    world::World dam;
    for (int y = -8; y <= 8; ++y)
        for (int x = -8; x <= 8; ++x)
            dam.insert({x, y}, std::make_shared<world::Chunk>(*world::damChunk({x, y}, bench::blocks())));
    std::vector<world::BlockEdit> edits;
    for (auto _ : state) benchmark::DoNotOptimize(world::flowLiquids(dam, bench::blocks(), {}, edits));
}

}  // namespace

BENCHMARK(breakDam)->Unit(benchmark::kMillisecond);
BENCHMARK(nothingFlows)->Unit(benchmark::kMicrosecond);

BENCHMARK_MAIN();
