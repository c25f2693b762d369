// Shapes painted into a tile, and a chunk of forest from its feet to its blocks. The label is a digest.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/gen/cpu/kernels.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/trees/trees.h"
#include "terrane/gen/language/builder.h"
#include "terrane/gen/language/compounds.h"
#include "terrane/gen/noise/stamp_tile.h"
#include "tests/support/default_heights.h"

namespace {

using namespace terrane;
using bench::blocks;
using bench::orExit;
using gen::Bits;
using gen::trees::Kind;

// Feet of a kind's shapes in 48×48 columns, on a slope; `perChunk` of them in 16×16.
struct Feet {
    std::vector<Bits> numbers, bases;
};

Feet feetOf(const gen::trees::KindRecord& kind, int perChunk) {
    constexpr int kSize = gen::kWindowSize;
    Feet feet = {std::vector<Bits>(std::size_t{kSize} * kSize, gen::bitsOf(-1)),
                 std::vector<Bits>(std::size_t{kSize} * kSize, gen::bitsOf(0))};
    for (int chunk = 0; chunk < 9; ++chunk) {
        for (int k = 0; k < perChunk; ++k) {
            const int x = chunk % 3 * 16 + k * 7 % 16, y = chunk / 3 * 16 + k * 16 / perChunk;
            const auto at = static_cast<std::size_t>(y * kSize + x);
            feet.numbers[at] = gen::bitsOf(kind.first + k % kind.count);
            feet.bases[at] = gen::bitsOf(80 + x / 3);
        }
    }
    return feet;
}

void paint(benchmark::State& state, Kind wanted) {
    gen::ShapeTable table;
    gen::trees::KindRecord kind;
    for (const gen::VoxelShape& shape : gen::trees::shapesOf(wanted)) {
        gen::addShape(table, shape, 0, blocks());
        ++kind.count;
    }
    const Feet feet = feetOf(kind, static_cast<int>(state.range(0)));
    gen::StampTile tile;
    for (auto _ : state) tile.paint(table, {}, feet.numbers, feet.bases);
    base::Digest digest;
    for (int z = 0; z < world::kChunkHeight; ++z) {
        if (tile.blocks().range(z).high == 0) continue;
        digest.update(std::as_bytes(std::span(tile.blocks().layer(z), gen::kTileLanes)));
    }
    state.SetLabel(digest.hex());
}

BENCHMARK_CAPTURE(paint, nothing, Kind::Oak)->Arg(0);
BENCHMARK_CAPTURE(paint, bushes, Kind::Bush)->Arg(20);
BENCHMARK_CAPTURE(paint, oaks, Kind::Oak)->Arg(5)->Arg(20);
BENCHMARK_CAPTURE(paint, spruces, Kind::Spruce)->Arg(20);
BENCHMARK_CAPTURE(paint, oldOaks, Kind::OldOak)->Arg(1)->Arg(4);

gen::GeneratorGraph forest(bool stamps) {
    using namespace gen;
    GeneratorBuilder g("forest", blocks());
    const trees::TreeKinds kinds = trees::record(g);
    const auto shape = g.field<Int>("shape"), base = g.field<Int>("base"), height = g.field<Int>("height");
    g.pass2D("feet", [&](Pass& p) {
        const ScatterPoint point = scatter(p, "trees", 4, 3);
        const Int surface = Int(p.perlin2D("hills", 64, {1.0f}) * 15.0f) + 80;
        p.set(height, surface);
        p.set(base, surface + 1);
        p.set(shape, select(point.isHere, shapeOf(of(kinds, trees::Kind::Oak), point.hash), Int(-1)));
    });
    g.pass3D("land", [&](Pass& p) {
        const Block above = stamps ? p.stamp(shape, base) : p.block("air");
        p.setBlock(select(p.z() <= p.read(height), p.block("stone"), above));
    });
    return orExit(g.finish());
}

void generate(benchmark::State& state, bool stamps) {
    constexpr int kSide = 16;
    for (auto _ : state) {
        state.PauseTiming();
        const gen::Generator generator(forest(stamps), 1);
        state.ResumeTiming();
        for (int k = 0; k < kSide * kSide; ++k) {
            benchmark::DoNotOptimize(generator.generate({k % kSide, k / kSide}));
        }
    }
    state.counters["chunk"] = benchmark::Counter(
        kSide * kSide, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(generate, forestOf16TreesAChunk, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(generate, withoutTrees, false)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
