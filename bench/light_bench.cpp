// Light on one thread, over the landscape scene with a view distance of 16. Labels are digests of the light:
// they change where the result does.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/terrane/scenes.h"
#include "terrane/base/digest.h"
#include "terrane/base/embedded.h"
#include "terrane/base/job_system.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/light/light_chunk.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> content();
}  // namespace terrane::embedded

namespace {

using namespace terrane;
using light::ChunkLight;
using light::LocalLight;

constexpr int kViewDistance = 16;
constexpr int kSide = 2 * kViewDistance + 3;  // chunks along x and y, one around those that are lit

template <class T>
T orExit(base::Result<T> result) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(1);
}

const world::BlockRegistry& blocks() {
    static const world::BlockRegistry registry = [] {
        std::string_view text;
        for (const base::EmbeddedFile& file : embedded::content()) {
            if (file.path == "blocks.toml") text = file.data;
        }
        return orExit(world::BlockRegistry::parse(text, "blocks.toml"));
    }();
    return registry;
}

const light::LightTable& table() {
    static const light::LightTable result(blocks());
    return result;
}

// Chunks of the scene with one around them, x fastest.
std::vector<world::Chunk> makeScene(std::string_view name) {
    const glm::dvec3 at = app::findScene(name)->camera.position;
    const world::ChunkPos centre =
        world::chunkOf({static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y), 0});
    const gen::Generator generator(orExit(gen::makeGenerator("overworld", blocks())), 1);
    std::vector<world::Chunk> chunks(kSide * kSide);
    base::JobSystem jobs(2);
    const auto done = base::parallelFor(jobs, chunks.size(), [&](std::size_t k) {
        chunks[k] = generator.generate({centre.x - kViewDistance - 1 + static_cast<int>(k) % kSide,
                                        centre.y - kViewDistance - 1 + static_cast<int>(k) / kSide});
    });
    if (!done) std::exit(1);
    return chunks;
}

const std::vector<world::Chunk>& landscape() {
    static const std::vector<world::Chunk> chunks = makeScene("landscape");
    return chunks;
}

std::vector<LocalLight> solveAll(const std::vector<world::Chunk>& chunks, light::LightScratch& scratch) {
    std::vector<LocalLight> locals;
    for (const world::Chunk& chunk : chunks) locals.push_back(solveLocal(chunk, table(), scratch));
    return locals;
}

std::vector<ChunkLight> lightAll(const std::vector<LocalLight>& locals, light::LightScratch& scratch) {
    std::vector<ChunkLight> lights;
    for (int y = 1; y < kSide - 1; ++y) {
        for (int x = 1; x < kSide - 1; ++x) {
            light::LocalNeighbourhood around;
            for (int k = 0; k < 9; ++k) {
                around[static_cast<std::size_t>(k)] =
                    &locals[static_cast<std::size_t>(x + k % 3 - 1 + kSide * (y + k / 3 - 1))];
            }
            lights.push_back(lightChunk(around, scratch));
        }
    }
    return lights;
}

std::string digestOf(const std::vector<ChunkLight>& lights) {
    base::Digest digest;
    std::vector<light::LightValue> values(world::kBlocksPerSection);
    for (const ChunkLight& chunk : lights) {
        for (int s = 0; s < world::kSectionsPerChunk; ++s) {
            chunk.brick(s).unpack(std::span(values).first<world::kBlocksPerSection>());
            digest.update(std::as_bytes(std::span(values)));
        }
    }
    return digest.hex();
}

// Time a chunk that is lit, the ring around the area (12 %) included.
benchmark::Counter perChunk(std::size_t chunks) {
    return {static_cast<double>(chunks),
            benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

constexpr std::size_t kLit = (kSide - 2) * (kSide - 2);

void local(benchmark::State& state) {
    light::LightScratch scratch;
    std::size_t bytes = 0;
    for (const LocalLight& one : solveAll(landscape(), scratch)) bytes += one.memoryBytes();
    for (auto _ : state) {
        for (const world::Chunk& chunk : landscape())
            benchmark::DoNotOptimize(solveLocal(chunk, table(), scratch));
    }
    state.counters["time/chunk"] = perChunk(landscape().size());
    state.counters["bytes"] = static_cast<double>(bytes) / static_cast<double>(landscape().size());
}

void neighbours(benchmark::State& state) {
    light::LightScratch scratch;
    const std::vector<LocalLight> locals = solveAll(landscape(), scratch);
    std::vector<ChunkLight> lights;
    for (auto _ : state) lights = lightAll(locals, scratch);
    std::size_t bytes = 0;
    for (const ChunkLight& chunk : lights) bytes += chunk.memoryBytes();
    state.counters["time/chunk"] = perChunk(kLit);
    state.counters["bytes"] = static_cast<double>(bytes) / kLit;
    state.SetLabel(digestOf(lights));
}

BENCHMARK(local)->Unit(benchmark::kMillisecond);
BENCHMARK(neighbours)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
