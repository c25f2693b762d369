// Generation on one thread. The label is a digest of what was made: it changes where the result does.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/gen/compile/program.h"
#include "terrane/gen/cpu/executor.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/language/builder.h"
#include "terrane/gen/language/compounds.h"
#include "tests/support/default_heights.h"

namespace {

using namespace terrane;
using bench::blocks;
using bench::orExit;
using gen::BlockLayers;
using gen::ColumnValues;
using world::ChunkPos;

constexpr std::uint64_t kSeed = 1;

constexpr world::Heights kTall = {-1024, 1024}, kOfWilderness = {-512, 1792};

gen::GeneratorGraph graphOf(std::string_view name, world::Heights heights = {}) {
    return orExit(gen::makeGenerator(name, blocks(), {0, heights}));
}

std::string digestOf(const std::vector<world::Chunk>& chunks) {
    base::Digest digest;
    std::vector<world::Section::Value> values(world::kBlocksPerSection);
    for (const world::Chunk& chunk : chunks) {
        const world::Heights heights = chunk.heights();
        for (int s = heights.firstSection(); s < heights.endSection(); ++s) {
            chunk.section(s).unpack(std::span(values).first<world::kBlocksPerSection>());
            digest.update(std::as_bytes(std::span(values)));
        }
    }
    return digest.hex();
}

// The sections that a view from above the ground needs: to four below the lowest one that is under the open
// sky.
class UnderSky {
  public:
    bool operator()(const world::Chunk& chunk, int lowest) {
        const world::Section& section = chunk.section(lowest);
        const bool isAir = section.isUniform() && section.uniformValue() == world::kAir;
        if (!isAir && !closed_.all()) close(section);
        below_ += closed_.all() ? 1 : 0;
        return below_ < 5;
    }

  private:
    void close(const world::Section& section) {
        std::vector<world::Section::Value> values(world::kBlocksPerSection);
        section.unpack(std::span(values).first<world::kBlocksPerSection>());
        for (std::size_t k = 0; k < values.size(); ++k)
            if (values[k] != world::kAir) closed_.set(k % closed_.size());
    }

    std::bitset<world::kBlocksPerLayer> closed_;
    int below_ = 0;
};

enum class Depth : std::uint8_t { Whole, UnderSky };

// One iteration makes `side`² chunks from each corner, in the order of rows, with a new generator.
void generateSquares(benchmark::State& state, const gen::GeneratorGraph& graph,
                     std::span<const ChunkPos> corners, int side, Depth depth) {
    std::vector<world::Chunk> chunks;
    for (auto _ : state) {
        state.PauseTiming();
        const gen::Generator generator(graph, kSeed);
        chunks.clear();
        state.ResumeTiming();
        for (const ChunkPos corner : corners) {
            for (int k = 0; k < side * side; ++k) {
                const ChunkPos pos{corner.x + k % side, corner.y + k / side};
                chunks.push_back(depth == Depth::Whole ? generator.generate(pos)
                                                       : generator.generateDown(pos, UnderSky()));
            }
        }
    }
    state.counters["chunks_per_second"] =
        benchmark::Counter(static_cast<double>(chunks.size()), benchmark::Counter::kIsIterationInvariantRate);
    state.SetLabel(digestOf(chunks));
}

void generateArea(benchmark::State& state, std::string_view name, ChunkPos corner = {0, 0},
                  world::Heights heights = {}, Depth depth = Depth::Whole) {
    generateSquares(state, graphOf(name, heights), std::array{corner}, 32, depth);
}

// Squares some 8 km apart, on land and in the sea: the mean of a world.
void generateSpread(benchmark::State& state, std::string_view name, world::Heights heights) {
    constexpr int kApart = 517, kPerSide = 4;
    std::vector<ChunkPos> corners;
    for (int k = 0; k < kPerSide * kPerSide; ++k)
        corners.push_back({(k % kPerSide - 2) * kApart, (k / kPerSide - 2) * kApart});
    generateSquares(state, graphOf(name, heights), corners, 12, Depth::UnderSky);
}

BENCHMARK_CAPTURE(generateArea, overworld, "overworld")->Unit(benchmark::kMillisecond)->MinTime(3);
// A range, a volcano, forests, rivers and a shore, within one region of the drainage map.
BENCHMARK_CAPTURE(generateArea, continents, "continents", ChunkPos{195, -125})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(3);
// Content down to the bottom, and sky that costs next to nothing.
BENCHMARK_CAPTURE(generateArea, overworld_tall, "overworld", ChunkPos{0, 0}, kTall)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
BENCHMARK_CAPTURE(generateArea, continents_tall, "continents", ChunkPos{195, -125}, kTall)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
BENCHMARK_CAPTURE(generateArea, overworld_under_sky, "overworld", ChunkPos{0, 0}, kTall, Depth::UnderSky)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
BENCHMARK_CAPTURE(generateArea, continents_under_sky, "continents", ChunkPos{195, -125}, kTall,
                  Depth::UnderSky)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
// Mountains, a coast and a river.
BENCHMARK_CAPTURE(generateArea, wilderness_under_sky, "wilderness", ChunkPos{0, 20}, kOfWilderness,
                  Depth::UnderSky)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
// Plains.
BENCHMARK_CAPTURE(generateArea, wilderness_plains_under_sky, "wilderness", ChunkPos{-160, 250}, kOfWilderness,
                  Depth::UnderSky)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
BENCHMARK_CAPTURE(generateSpread, continents, "continents", kTall)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
BENCHMARK_CAPTURE(generateSpread, wilderness, "wilderness", kOfWilderness)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2);
BENCHMARK_CAPTURE(generateArea, flat_tall, "flat", ChunkPos{0, 0}, kTall)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generateArea, flat, "flat")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generateArea, hills3d, "hills3d")->Unit(benchmark::kMillisecond)->Iterations(2);
BENCHMARK_CAPTURE(generateArea, voronoi, "voronoi")->Unit(benchmark::kMillisecond)->Iterations(2);

// All passes of a generator over a square of chunks, pass after pass, with everything kept. At the edge of
// the square the chunk itself stands for neighbors that are missing.
class PassArea {
  public:
    static constexpr int kSide = 10;
    static constexpr int kChunks = kSide * kSide;

    explicit PassArea(gen::GeneratorGraph g) : graph(std::move(g)), columns_(kChunks), solid_(kChunks) {
        seeds_.noises.resize(graph.noises.size());
        seeds_.hashes.resize(graph.hashNames.size());
        for (std::size_t k = 0; k < seeds_.noises.size(); ++k) seeds_.noises[k] = seedOf(k);
        for (std::size_t k = 0; k < seeds_.hashes.size(); ++k) seeds_.hashes[k] = seedOf(k + 1000);
        executor_ = std::make_unique<gen::Executor>(graph.noises, seeds_,
                                                    gen::ExecutorParts{.shapes = graph.shapes.get()});
        for (const gen::PassGraph& pass : graph.passes) {
            programs_.push_back(compile(pass, graph.noises));
            voxelPasses_.push_back(pass.is3D ? std::make_unique<gen::VoxelPass>(pass, graph.noises)
                                             : nullptr);
        }
        for (int n = 0; n < kChunks; ++n) {
            at(columns_, n).resize(graph.fields.size());
            at(solid_, n).resize(graph.passes.size());
        }
        for (std::size_t pass = 0; pass < graph.passes.size(); ++pass) {
            for (int n = 0; n < kChunks; ++n) run(pass, n);
        }
    }

    // Makes the results of a pass for chunk n (again).
    void run(std::size_t pass, int n) {
        const gen::Program& program = programs_[pass];
        const gen::PassInputs inputs = inputsOf(pass, n);
        if (program.is3D) {
            auto& result = at(solid_, n)[pass];
            if (!result) result = std::make_unique<BlockLayers>(graph.heights);
            return executor_->run3D(*voxelPasses_[pass], inputs, *result);
        }
        std::vector<ColumnValues*> results;
        for (const auto& f : program.fields) results.push_back(&at(columns_, n)[f.field]);
        executor_->run2D(program, inputs, results);
    }

    std::string digest(std::size_t pass) {
        base::Digest digest;
        for (int n = 0; n < kChunks; ++n) {
            for (int z = 0; programs_[pass].is3D && z < world::kChunkHeight; ++z) {
                const std::uint16_t* layer = at(solid_, n)[pass]->layer(z);
                digest.update(std::as_bytes(std::span(layer, gen::kTileLanes)));
            }
            for (const auto& f : programs_[pass].fields) {
                digest.update(std::as_bytes(std::span(at(columns_, n)[f.field])));
            }
        }
        return digest.hex();
    }

    gen::GeneratorGraph graph;

  private:
    static std::uint32_t seedOf(std::size_t k) { return static_cast<std::uint32_t>(k) * 0x9E3779B9u + 7; }

    template <class T>
    static T& at(std::vector<T>& values, int n) {
        return values[static_cast<std::size_t>(n)];
    }

    gen::PassInputs inputsOf(std::size_t pass, int n) {
        gen::PassInputs inputs;
        const int x = n % kSide, y = n / kSide;
        inputs.chunk = {x, y};
        inputs.fields.resize(graph.fields.size());
        for (int k = 0; k < 9; ++k) {
            const int nx = std::clamp(x + k % 3 - 1, 0, kSide - 1),
                      ny = std::clamp(y + k / 3 - 1, 0, kSide - 1);
            auto& values = at(columns_, ny * kSide + nx);
            for (std::size_t f = 0; f < values.size(); ++f) {
                inputs.fields[f][static_cast<std::size_t>(k)] = &values[f];
            }
        }
        for (std::size_t earlier = 0; earlier < pass; ++earlier) {
            if (programs_[earlier].is3D) inputs.blocks[4] = at(solid_, n)[earlier].get();
        }
        return inputs;
    }

    gen::Seeds seeds_;
    std::vector<gen::Program> programs_;
    std::vector<std::unique_ptr<gen::VoxelPass>> voxelPasses_;  // by pass; null for 2D ones
    std::unique_ptr<gen::Executor> executor_;
    std::vector<std::vector<ColumnValues>> columns_;                // by chunk, by field
    std::vector<std::vector<std::unique_ptr<BlockLayers>>> solid_;  // by chunk, by pass
};

// One iteration is one chunk's pass.
void runPass(benchmark::State& state, PassArea& area, std::size_t pass, int samples) {
    int n = 0;
    for (auto _ : state) {
        area.run(pass, n);
        n = (n + 1) % PassArea::kChunks;
    }
    if (samples > 0) {
        state.counters["time/sample"] = benchmark::Counter(
            samples, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    }
    state.SetLabel(area.digest(pass));
}

void registerPass(const std::string& name, std::shared_ptr<PassArea> area, std::size_t pass, int samples) {
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        runPass(state, *area, pass, samples);
    })->Unit(benchmark::kMicrosecond);
}

void registerOverworldPasses() {
    const auto area = std::make_shared<PassArea>(graphOf("overworld"));
    for (std::size_t pass = 0; pass < area->graph.passes.size(); ++pass) {
        registerPass("overworldPass/" + area->graph.passes[pass].name, area, pass, 0);
    }
}

using NoiseOf = std::function<gen::Float(gen::Pass&)>;

// A 2D pass that keeps the noise: its time is that of a tile of 256 samples and what they share.
void registerNoise2D(const std::string& name, const NoiseOf& noise) {
    gen::GeneratorBuilder g("noise", blocks());
    const auto field = g.field<gen::Float>("noise");
    g.pass2D("noise", [&](gen::Pass& p) { p.set(field, noise(p)); });
    g.pass3D("last", [](gen::Pass&) {});
    registerPass(name, std::make_shared<PassArea>(orExit(g.finish())), 0, gen::kTileLanes);
}

// A 3D pass that compares the noise: the comparison and the block's store are in the time.
void registerNoise3D(const std::string& name, const NoiseOf& noise) {
    gen::GeneratorBuilder g("noise", blocks());
    g.pass3D("noise",
             [&](gen::Pass& p) { p.setBlock(select(noise(p) > 0.2f, p.block("stone"), p.block("air"))); });
    registerPass(name, std::make_shared<PassArea>(orExit(g.finish())), 0, world::kBlocksPerChunk);
}

void registerNoises() {
    const std::vector<float> one = {1.0f}, four = {0.1f, 0.2f, 0.4f, 0.8f};
    for (const int size : {8, 32}) {
        for (const auto& weights : {one, four}) {
            const std::string suffix =
                "/size:" + std::to_string(size) + "/octaves:" + std::to_string(weights.size());
            registerNoise2D("perlin2D" + suffix,
                            [&](gen::Pass& p) { return p.perlin2D("noise", size, weights); });
            registerNoise2D("simplex2D" + suffix,
                            [&](gen::Pass& p) { return p.simplex2D("noise", size, weights); });
            registerNoise3D("perlin3D" + suffix,
                            [&](gen::Pass& p) { return p.perlin3D("noise", size, weights); });
        }
    }
    for (const int size : {8, 128}) {
        registerNoise2D("stripes2D/size:" + std::to_string(size), [&](gen::Pass& p) {
            return p.stripes2D("noise", size, {0.6f, 0.8f}).cosine;
        });
    }
    // A synthetic slope, so that only the filter is timed.
    registerNoise2D("erode/octaves:5", [&](gen::Pass& p) {
        const gen::Float x(p.x() & 15), y(p.y() & 15);
        return gen::erode(p, "gullies", {x * 0.05f, y * 0.03f}, 1.0f, {}).height;
    });
    for (const int size : {10, 64, 512}) {
        registerNoise2D("voronoi2D/size:" + std::to_string(size),
                        [&](gen::Pass& p) { return p.voronoi2D("noise", size, 2).distance; });
    }
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    registerOverworldPasses();
    registerNoises();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
