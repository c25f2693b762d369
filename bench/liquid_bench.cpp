// Water that flows: a dam is broken above a valley of 64×64 blocks. One iteration is a whole flood, until it
// has settled. `median_ms` and `max_ms` are of its ticks, of each the median of all iterations; the digest is
// of the settled world.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/statistics.h"
#include "terrane/world/changes/random_ticks.h"
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
    std::vector<std::vector<double>> times;  // by tick
    std::size_t cells = 0, mostCells = 0;
    for (auto _ : state) {
        state.PauseTiming();
        world::World dam = makeWorld();
        state.ResumeTiming();
        const Flood made = flood(dam);
        state.PauseTiming();
        times.resize(made.tickMs.size());
        for (std::size_t tick = 0; tick < times.size(); ++tick) times[tick].push_back(made.tickMs[tick]);
        cells = made.cells;
        mostCells = made.mostCells;
        state.SetLabel(world::damDigest(dam));
        state.ResumeTiming();
    }
    std::vector<double> medians;
    for (const std::vector<double>& tick : times) medians.push_back(base::medianOf(tick));
    state.counters["ticks"] = static_cast<double>(times.size());
    state.counters["cells"] = static_cast<double>(cells);
    state.counters["most_cells"] = static_cast<double>(mostCells);
    state.counters["median_ms"] = base::medianOf(medians);
    state.counters["max_ms"] = *std::ranges::max_element(medians);
}

// As many cells as a tick takes: new sources side by side, which all flow on.
void fullTick(benchmark::State& state) {
    const world::BlockId water = bench::blockId("water");
    std::size_t cells = 0;
    for (auto _ : state) {
        state.PauseTiming();
        world::World dam = makeWorld();
        std::vector<world::BlockEdit> edits;
        for (int z = 100; z < 120; z += 2)
            for (int y = 2; y < 62; y += 2)
                for (int x = 2; x < 62; x += 2)
                    world::applyChange(dam, bench::blocks(), {x, y, z}, world::SetBlock{water}, edits);
        state.ResumeTiming();
        cells = world::flowLiquids(dam, bench::blocks(), world::kDamArea, edits);
        state.PauseTiming();
        { const world::World gone = std::move(dam); }
        state.ResumeTiming();
    }
    state.counters["cells"] = static_cast<double>(cells);
}

// A tick where nothing flows, over 17×17 chunks.
void nothingFlows(benchmark::State& state) {
    world::World dam;
    for (int y = -8; y <= 8; ++y)
        for (int x = -8; x <= 8; ++x)
            dam.insert({x, y}, std::make_shared<world::Chunk>(*world::damChunk({x, y}, bench::blocks())));
    std::vector<world::BlockEdit> edits;
    for (auto _ : state)
        benchmark::DoNotOptimize(
            world::flowLiquids(dam, bench::blocks(), world::chunksWithin({}, world::kTickRadius), edits));
}

}  // namespace

BENCHMARK(breakDam)->Unit(benchmark::kMillisecond);
BENCHMARK(fullTick)->Unit(benchmark::kMillisecond);
BENCHMARK(nothingFlows)->Unit(benchmark::kMicrosecond);

BENCHMARK_MAIN();
