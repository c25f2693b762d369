// Statistics of the land that `continents` makes: bench_land [SEEDS]. A table, not times.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/gen/drainage/drainage_heights.h"
#include "terrane/gen/drainage/drainage_network.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/continents.h"

namespace {

using namespace terrane;
using gen::Bits;
using gen::continents::Biome;

// 1,024 columns of 64 blocks along x and y: 4,295 km² a seed.
constexpr int kLevel = 6, kTiles = 64, kSide = kTiles * 16;

// The 2D passes of continents at one level, whose fields are read by name.
class Columns {
  public:
    Columns(std::uint64_t seed, int level)
        : level_(level), graph_(bench::orExit(gen::makeGenerator("continents", bench::blocks(), level))) {
        std::erase_if(graph_.passes, [](const gen::PassGraph& pass) { return pass.is3D; });
        generator_ = std::make_unique<gen::Generator>(graph_, seed);
    }

    // A square of tiles from (first, first), by y, then x.
    std::vector<Bits> square(std::string_view field, int first, int tiles) const {
        const auto number = static_cast<std::uint32_t>(
            std::ranges::find(graph_.fields, field, &gen::FieldInfo::name) - graph_.fields.begin());
        const int side = tiles * 16;
        std::vector<Bits> values(static_cast<std::size_t>(side * side));
        for (int k = 0; k < tiles * tiles; ++k) {
            const int tileX = k % tiles, tileY = k / tiles;
            const auto tile = generator_->columns(
                {first + tileX, first + tileY, static_cast<std::uint8_t>(level_)}, number);
            for (int n = 0; n < 256; ++n) {
                const int x = tileX * 16 + n % 16, y = tileY * 16 + n / 16;
                values[static_cast<std::size_t>(x + y * side)] = tile[static_cast<std::size_t>(n)];
            }
        }
        return values;
    }

  private:
    int level_;
    gen::GeneratorGraph graph_;
    std::unique_ptr<gen::Generator> generator_;
};

struct Statistics {
    std::array<double, static_cast<std::size_t>(Biome::Count)> biomes{};  // columns
    double columns = 0, land = 0;
    std::array<double, 5> slopes{};             // land columns with slopes above 0.5, 1, 2, 4, and all
    double correlation = 0;                     // of heights far apart, the largest
    int straightBorder = 0, straightNoise = 0;  // columns
};

bool isLand(Bits biome) {
    return biome > static_cast<Bits>(Biome::Reef);
}

// Steps along x whose heights have the largest correlation, beyond the size of continents.
double farCorrelation(const std::vector<double>& heights, int along) {
    double mean = 0, variance = 0;
    for (const double h : heights) mean += h / static_cast<double>(heights.size());
    for (const double h : heights) variance += (h - mean) * (h - mean);
    double largest = 0;
    const int other = along == 1 ? kSide : 1;
    for (int lag = 192; lag < kSide / 2; lag += 4) {
        double sum = 0;
        for (int a = 0; a + lag < kSide; ++a) {
            for (int b = 0; b < kSide; b += 2) {
                const auto at = static_cast<std::size_t>(a * along + b * other);
                sum +=
                    2 * (heights[at] - mean) * (heights[at + static_cast<std::size_t>(lag * along)] - mean);
            }
        }
        largest = std::max(largest, std::abs(sum / variance * kSide / (kSide - lag)));
    }
    return largest;
}

// The longest straight piece of a border between different values, along either axis.
int longestStraight(const std::vector<Bits>& values, int side) {
    int longest = 0;
    for (const int along : {1, side}) {
        const int across = along == 1 ? side : 1;
        for (int a = 0; a + 1 < side; ++a) {
            int run = 0;
            for (int b = 0; b < side; ++b) {
                const auto at = static_cast<std::size_t>(a * across + b * along);
                run = values[at] != values[at + static_cast<std::size_t>(across)] ? run + 1 : 0;
                longest = std::max(longest, run);
            }
        }
    }
    return longest;
}

void addCoarse(Statistics& s, std::uint64_t seed) {
    const Columns columns(seed, kLevel);
    const auto biomes = columns.square("biome", -kTiles / 2, kTiles);
    const auto heights = columns.square("height", -kTiles / 2, kTiles);
    for (const Bits b : biomes) {
        s.biomes[b] += 1;
        s.columns += 1;
        s.land += isLand(b);
    }
    std::vector<double> values;
    for (const Bits h : heights) values.push_back(double{gen::asFloat(h)});
    s.correlation = std::max({s.correlation, farCorrelation(values, 1), farCorrelation(values, kSide)});
}

// At level 0: slopes, and how straight borders of biomes are beside those of a noise.
void addFine(Statistics& s, std::uint64_t seed) {
    constexpr int kFine = 24, kFineSide = kFine * 16;
    const Columns columns(seed, 0);
    for (const int corner : {-300, -100, 60, 250}) {
        const auto biomes = columns.square("biome", corner, kFine);
        const auto heights = columns.square("height", corner, kFine);
        s.straightBorder = std::max(s.straightBorder, longestStraight(biomes, kFineSide));
        std::vector<Bits> noise;
        for (const Bits h : heights) noise.push_back(gen::asFloat(h) > 100.0f ? 1 : 0);
        s.straightNoise = std::max(s.straightNoise, longestStraight(noise, kFineSide));
        for (int k = 0; k + kFineSide + 1 < kFineSide * kFineSide; ++k) {
            const auto at = static_cast<std::size_t>(k);
            if (!isLand(biomes[at]) || k % kFineSide == kFineSide - 1)
                continue;  // the next one is of another row
            const float here = gen::asFloat(heights[at]);
            const float slope = std::hypot(gen::asFloat(heights[at + 1]) - here,
                                           gen::asFloat(heights[at + kFineSide]) - here);
            constexpr std::array<float, 4> kAbove = {0.5f, 1, 2, 4};
            for (std::size_t n = 0; n < kAbove.size(); ++n) s.slopes[n] += slope > kAbove[n];
            s.slopes[4] += 1;
        }
    }
}

struct Rivers {
    long rivers = 0, reachSea = 0, reachLake = 0, rings = 0, leave = 0;  // nodes; `leave`: the window
};

// Follows the water of each river node of a window of 256×256 nodes, the same square as the columns.
void addRivers(Rivers& r, std::uint64_t seed) {
    constexpr int kNodes = 256, kMargin = gen::kNetworkMargin + 2, kWindow = (kNodes + 2 * kMargin) / 8 * 8;
    const gen::GeneratorGraph graph = bench::orExit(gen::makeGenerator("continents", bench::blocks()));
    const gen::DrainageHeights heights(graph.drainages.front(), seed);
    gen::DrainageNetwork n;
    n.side = kWindow;
    n.heights = heights.nodes({-kWindow / 16 * 8, -kWindow / 16 * 8}, kWindow).heights;
    gen::findDrainage(n, heights.spec());
    for (int k = 0; k < kNodes * kNodes; ++k) {
        std::size_t node = n.at(kMargin + k % kNodes, kMargin + k / kNodes);
        if (n.flows[node] < heights.spec().minFlow || n.drains[node] == gen::kNoDrain) continue;
        ++r.rivers;
        int steps = 0;
        while (n.drains[node] != gen::kNoDrain && ++steps < kWindow * kWindow) node = n.drainOf(node);
        const int x = static_cast<int>(node) % kWindow, y = static_cast<int>(node) / kWindow;
        if (steps == kWindow * kWindow) {
            ++r.rings;
        } else if (gen::heightOf(n.heights[node]) < heights.spec().seaLevel) {
            ++r.reachSea;
        } else if (n.lakeNodes[node] > 0) {
            ++r.reachLake;
        } else if (std::min({x, y, kWindow - 1 - x, kWindow - 1 - y}) <= gen::kFloodReach) {
            ++r.leave;
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 16;
    Statistics s;
    Rivers r;
    for (int seed = 1; seed <= seeds; ++seed) {
        addCoarse(s, static_cast<std::uint64_t>(seed));
        addFine(s, static_cast<std::uint64_t>(seed));
        addRivers(r, static_cast<std::uint64_t>(seed));
    }
    std::printf("%d seeds, %.0f km2 of columns 64 blocks wide\n", seeds, s.columns * 64 * 64 / 1e6);
    std::printf("land %.1f %%\n", 100 * s.land / s.columns);
    for (std::size_t b = 0; b < s.biomes.size(); ++b) {
        if (!isLand(static_cast<Bits>(b))) continue;
        std::printf("  %-12s %5.1f %% of the land\n", gen::continents::biomeName(static_cast<Biome>(b)),
                    100 * s.biomes[b] / s.land);
    }
    std::printf("slopes above 0.5: %.1f %%, 1: %.1f %%, 2: %.2f %%, 4: %.2f %%\n",
                100 * s.slopes[0] / s.slopes[4], 100 * s.slopes[1] / s.slopes[4],
                100 * s.slopes[2] / s.slopes[4], 100 * s.slopes[3] / s.slopes[4]);
    std::printf("correlation of heights 12 to 32 km apart: at most %.3f\n", s.correlation);
    std::printf(
        "rivers: %ld nodes; %.2f %% reach the sea, %.2f %% a lake, %.2f %% leave the area; %ld rings\n",
        r.rivers, 100.0 * static_cast<double>(r.reachSea) / static_cast<double>(r.rivers),
        100.0 * static_cast<double>(r.reachLake) / static_cast<double>(r.rivers),
        100.0 * static_cast<double>(r.leave) / static_cast<double>(r.rivers), r.rings);
    std::printf("longest straight border: of biomes %d blocks, of a contour line of the ground %d blocks\n",
                s.straightBorder, s.straightNoise);
}
