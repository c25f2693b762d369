// Tiles of a map from nothing, on one thread: the whole way, and its steps alone. The label is a digest of
// what was made: it changes where the result does.
#include <benchmark/benchmark.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/base/image.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/map/map_painter.h"
#include "terrane/map/paint.h"

namespace {

using namespace terrane;
using bench::blocks;
using bench::orExit;
using map::MapTile;

constexpr std::uint64_t kSeed = 1;
constexpr int kTilesAcross = 4;

// 4×4 tiles in the order of rows. At zoom 0 they hold a range, a volcano, forests, rivers and a shore.
std::vector<MapTile> tilesAt(int zoom) {
    const std::int32_t x = 12 >> -zoom, y = -8 >> -zoom;
    std::vector<MapTile> tiles;
    for (int k = 0; k < kTilesAcross * kTilesAcross; ++k)
        tiles.push_back({map::Layer::Day, zoom, x + k % kTilesAcross, y + k / kTilesAcross});
    return tiles;
}

// The generator of the zoom exists and has generated nothing.
gen::LevelGenerators newGenerators(std::string_view name, int zoom) {
    auto generators = orExit(gen::makeLevelGenerators(name, blocks(), kSeed));
    orExit(generators.at(map::levelOf(zoom)));
    return generators;
}

void reportTiles(benchmark::State& state, base::Digest& digest) {
    state.counters["tiles_per_second"] =
        benchmark::Counter(kTilesAcross * kTilesAcross, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["time/tile"] =
        benchmark::Counter(kTilesAcross * kTilesAcross,
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.SetLabel(digest.hex());
}

// One iteration paints all tiles as PNG files, with generators that know nothing of them yet.
void coldTiles(benchmark::State& state, std::string_view generator) {
    const int zoom = -static_cast<int>(state.range(0));
    std::optional<gen::LevelGenerators> generators;
    std::optional<map::MapPainter> painter;
    std::vector<std::string> files;
    for (auto _ : state) {
        state.PauseTiming();
        painter.reset();
        generators.emplace(newGenerators(generator, zoom));
        painter.emplace(orExit(map::MapPainter::create({*generators, blocks(), content::builtInTextures()})));
        files.clear();
        state.ResumeTiming();
        for (const MapTile& tile : tilesAt(zoom)) files.push_back(orExit(painter->paint(tile, {})));
    }
    base::Digest digest;
    for (const std::string& file : files) {
        const base::Image image = orExit(base::decodePng(file, "a tile"));
        digest.update(std::as_bytes(std::span(image.rgba)));
    }
    reportTiles(state, digest);
}

// The surfaces of the same tiles.
void coldSurfaces(benchmark::State& state, std::string_view generator) {
    const int zoom = -static_cast<int>(state.range(0));
    const map::SurfaceKinds kinds = map::surfaceKinds(blocks());
    std::optional<gen::LevelGenerators> generators;
    std::optional<map::SurfaceSource> source;
    std::vector<map::SurfaceArea> areas;
    for (auto _ : state) {
        state.PauseTiming();
        source.reset();
        generators.emplace(newGenerators(generator, zoom));
        source.emplace(map::SurfaceSource::Parts{*generators, kinds});
        areas.clear();
        state.ResumeTiming();
        for (const MapTile& tile : tilesAt(zoom))
            areas.push_back(orExit(source->area(map::columnsOf(tile), {})));
    }
    base::Digest digest;
    for (const map::SurfaceArea& area : areas) digest.update(std::as_bytes(std::span(area.columns)));
    reportTiles(state, digest);
}

// Painting and compression of tiles whose surfaces are known.
void knownTiles(benchmark::State& state, bool compresses) {
    const int zoom = -static_cast<int>(state.range(0));
    const gen::LevelGenerators generators = newGenerators("continents", zoom);
    const map::SurfaceKinds kinds = map::surfaceKinds(blocks());
    map::SurfaceSource source({generators, kinds});
    map::TintSource tints(generators);
    const map::MapColors colors = orExit(map::mapColors(blocks(), content::builtInTextures()));
    std::vector<map::SurfaceArea> areas;
    std::vector<map::TintField> fields;
    std::vector<base::Image> images;
    for (const MapTile& tile : tilesAt(zoom)) {
        areas.push_back(orExit(source.area(map::columnsOf(tile), {})));
        fields.push_back(tints.field(map::columnsOf(tile)));
        images.push_back(map::paintDay({areas.back(), fields.back()}, colors));
    }
    base::Digest digest;
    for (const base::Image& image : images) digest.update(std::as_bytes(std::span(image.rgba)));
    for (auto _ : state) {
        for (std::size_t k = 0; k < areas.size(); ++k) {
            if (compresses)
                benchmark::DoNotOptimize(base::encodePngFast(images[k]));
            else
                benchmark::DoNotOptimize(map::paintDay({areas[k], fields[k]}, colors));
        }
    }
    reportTiles(state, digest);
}

BENCHMARK_CAPTURE(coldTiles, continents, "continents")
    ->Arg(0)
    ->Arg(2)
    ->Arg(4)
    ->Arg(8)
    ->ArgName("level")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coldTiles, overworld, "overworld")
    ->Arg(0)
    ->Arg(4)
    ->ArgName("level")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coldSurfaces, continents, "continents")
    ->Arg(0)
    ->Arg(2)
    ->Arg(4)
    ->Arg(8)
    ->ArgName("level")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(knownTiles, paint, false)->Arg(0)->Arg(4)->ArgName("level")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(knownTiles, png, true)->Arg(0)->Arg(4)->ArgName("level")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
