// Statistics of the land that a generator makes, beside those of Earth. Tables, not times.
//   bench_land [GENERATOR [SEEDS [SPAWNS]]]     continents, 16 seeds, spawns of 200
// tools/land_plots.py draws them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "bench/bench_content.h"
#include "bench/land_figures.h"
#include "bench/river_figures.h"
#include "bench/spawn_figures.h"
#include "terrane/gen/generators/catalogue.h"

namespace {

using namespace terrane;
using namespace terrane::bench;

const LandKind& kindNamed(std::string_view name) {
    const auto found = std::ranges::find(landKinds(), name, &LandKind::generator);
    if (found != landKinds().end()) return *found;
    std::fprintf(stderr, "usage: bench_land [GENERATOR [SEEDS [SPAWNS]]]; generators:");
    for (const LandKind& kind : landKinds())
        std::fprintf(stderr, " %.*s", static_cast<int>(kind.generator.size()), kind.generator.data());
    std::fprintf(stderr, "\n");
    std::exit(1);
}

void printLand(const LandStatistics& s, const LandKind& kind) {
    std::printf("%.0f seeds, %.0f km2 of columns 64 blocks wide\n", s.seeds, s.columns * 64 * 64 / 1e6);
    std::printf("land %.1f %%\n", 100 * s.land / s.columns);
    for (int b = 0; b < kind.biomes; ++b) {
        const double share = s.biomes[static_cast<std::size_t>(b)];
        const bool isLand = b >= kind.firstLandBiome;
        std::printf("  %-13s %5.1f %% of the %s\n", kind.biomeName(b),
                    100 * share / (isLand ? s.land : s.columns - s.land), isLand ? "land" : "sea");
    }
    std::printf("slopes above 0.5: %.1f %%, 1: %.1f %%, 2: %.2f %%, 4: %.2f %%\n",
                100 * s.slopes[0] / s.slopes[4], 100 * s.slopes[1] / s.slopes[4],
                100 * s.slopes[2] / s.slopes[4], 100 * s.slopes[3] / s.slopes[4]);
}

// Earth's land and sea have the same shares of the area as those of the generator.
void printHeights(const LandStatistics& s) {
    std::printf(
        "hypsometry: blocks above the sea, %% of the area, Earth's (%.0f m a block above, %.0f below)\n",
        kEarthLand, kEarthSea);
    double land = 0;
    for (const auto& [number, columns] : s.heights) land += number >= 0 ? columns / s.columns : 0;
    for (int number = s.heights.begin()->first; number <= s.heights.rbegin()->first; ++number) {
        const auto found = s.heights.find(number);
        const double share = found == s.heights.end() ? 0 : found->second / s.columns;
        const int from = number * kHeightClass;
        std::printf("%7d %8.3f %8.3f\n", from, 100 * share, earthShare(from) * (from >= 0 ? land : 1 - land));
    }
}

void printRelief(const char* where, std::vector<float>& relief) {
    std::printf("  %-28s median %4.0f, 10 %% below %4.0f, 10 %% above %4.0f; %zu windows\n", where,
                static_cast<double>(percentile(relief, 0.5)), static_cast<double>(percentile(relief, 0.1)),
                static_cast<double>(percentile(relief, 0.9)), relief.size());
}

void printReliefs(LandStatistics& s) {
    std::printf(
        "of the land: %.1f %% range, %.1f %% lowland, %.2f %% lowland with nothing else within 0.5 km\n",
        100 * static_cast<double>(s.rangeRelief.size()) / s.places,
        100 * static_cast<double>(s.lowlandRelief.size()) / s.places,
        100 * static_cast<double>(s.wideLowlandRelief.size()) / s.places);
    std::printf("local relief within 1 km, blocks:\n");
    printRelief("around a place in a range", s.rangeRelief);
    printRelief("around a place in a lowland", s.lowlandRelief);
    printRelief("where all is lowland", s.wideLowlandRelief);
    std::printf(
        "peaks, highest within 2 km, in ranges: median %.0f, 90th percentile %.0f, highest %.0f; %zu peaks\n",
        static_cast<double>(percentile(s.peaks, 0.5)), static_cast<double>(percentile(s.peaks, 0.9)),
        static_cast<double>(percentile(s.peaks, 1)), s.peaks.size());
}

void printCorrelation(const LandStatistics& s) {
    std::printf("correlation of heights, mean of seeds: km, along x, along y\n");
    double largest = 0;
    for (std::size_t k = 0; k < s.correlation[0].size(); ++k) {
        const double x = s.correlation[0][k] / s.seeds, y = s.correlation[1][k] / s.seeds;
        if (k >= kFarLag / kLagStep) largest = std::max({largest, std::abs(x), std::abs(y)});
        if (k % 8 == 0 || (k < 8 && k % 2 == 0))
            std::printf("%7.2f %7.3f %7.3f\n", static_cast<double>(k) * kLagStep * 64 / 1000, x, y);
    }
    std::printf("12 to 32 km apart: at most %.3f in the mean, %.3f for one seed\n", largest,
                s.largestCorrelation);
}

void printBorders(const char* what, const Borders& borders) {
    const StraightPiece& p = borders.longest;
    std::printf("longest straight border of %s: %d blocks (seed %d, %d, %d); %ld longer than %d\n", what,
                p.blocks, static_cast<int>(p.seed), p.x, p.y, borders.tooLong, kMaxStraight);
}

void printOrders(const char* what, const StreamOrders& orders) {
    std::printf("%s by Strahler order (number, mean km):", what);
    for (std::size_t k = 0; k < orders.streams.size() && orders.streams[k] > 0; ++k)
        std::printf(" %.0f, %.2f;", orders.streams[k], orders.length[k] / orders.streams[k]);
    std::printf(" Horton's bifurcation ratio %.2f, length ratio %.2f\n", bifurcationRatio(orders),
                lengthRatio(orders));
}

void printBins(const char* what, const std::vector<AreaBin>& bins) {
    std::printf("%s by area: km2, slope, longest way upstream in km, nodes\n", what);
    for (const AreaBin& bin : bins) {
        if (!counts(bin)) continue;
        std::printf("%10.4f %9.6f %8.3f %8.0f\n", std::pow(10.0, bin.area / bin.nodes), bin.slope / bin.nodes,
                    std::pow(10.0, bin.length / bin.nodes), bin.nodes);
    }
}

void printFlint(const char* where, const PowerLaw& flint) {
    std::printf("Flint's law%s: S = %.4f A^%.3f, R2 %.3f\n", where, flint.factor, flint.exponent, flint.r2);
}

void printRivers(const RiverStatistics& s) {
    const auto share = [&](long nodes) {
        return 100.0 * static_cast<double>(nodes) / static_cast<double>(s.rivers);
    };
    std::printf(
        "rivers: %ld nodes in %.0f km2; %.2f %% reach the sea, %.2f %% a lake, %.2f %% leave the area; %ld "
        "end, "
        "%ld in rings\n",
        s.rivers, s.km2, share(s.reachSea), share(s.reachLake), share(s.leave), s.end, s.rings);
    std::printf("largest basin %.1f km2, longest river %.1f km\n", s.largestKm2, s.longestKm);
    printBins("streams", s.bins);
    printFlint("", slopeLaw(s, s.bins));
    if (!s.steepBins.empty()) {
        printBins("streams of steep land", s.steepBins);
        printFlint(" of steep land", slopeLaw(s, s.steepBins));
        printBins("streams of gentle land", s.gentleBins);
        printFlint(" of gentle land", slopeLaw(s, s.gentleBins));
    }
    const PowerLaw hack = lengthLaw(s);
    std::printf("Hack's law: L = %.3f A^%.3f, R2 %.3f\n", hack.factor, hack.exponent, hack.r2);
    for (std::size_t k = 0; k < kStreamKinds.size(); ++k) printOrders(kStreamKinds[k].name, s.orders[k]);
}

void printSpawns(SpawnStatistics& s) {
    std::printf(
        "spawns: %d of %d on land; of the 2 km around in view: median %.1f %%, 10 %% below %.1f %%; relief "
        "in "
        "view: median %.0f, 10 %% below %.0f\n",
        s.onLand, s.spawns, 100.0 * double{percentile(s.seen, 0.5)}, 100.0 * double{percentile(s.seen, 0.1)},
        double{percentile(s.relief, 0.5)}, double{percentile(s.relief, 0.1)});
}

}  // namespace

int main(int argc, char** argv) {
    const LandKind& kind = kindNamed(argc > 1 ? argv[1] : "continents");
    const int seeds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 16;
    const int spawns = argc > 3 ? std::max(0, std::atoi(argv[3])) : 200;
    const gen::GeneratorGraph graph = orExit(gen::makeGenerator(kind.generator, blocks()));
    LandStatistics land;
    RiverStatistics rivers;
    SpawnStatistics starts;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds); ++seed) {
        addLand(land, kind, seed);
        addRelief(land, kind, seed);
        addGround(land, kind, seed);
        addRivers(rivers, graph.drainages.front(), seed);
    }
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(spawns); ++seed)
        addSpawn(starts, kind, seed);
    printLand(land, kind);
    printHeights(land);
    printReliefs(land);
    printCorrelation(land);
    printBorders("biomes", land.biomeBorders);
    printBorders("contour lines", land.contours);
    printRivers(rivers);
    if (spawns > 0) printSpawns(starts);
}
