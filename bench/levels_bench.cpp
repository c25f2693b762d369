// Tiles of each level compared with the chunks under them: cost, heights, kinds of ground, crowns, water.
//   bench_levels [GENERATOR [PLACES]]     overworld, 24 places of 512×512 blocks
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "bench/bench_content.h"
#include "bench/level_figures.h"
#include "terrane/gen/generators/catalogue.h"

namespace {

using namespace terrane;
using world::ChunkPos;

constexpr int kFigureLevels = 5;  // a tile of level 5 is 512 blocks wide
constexpr int kSide = 32;         // chunks

// Places in the overworld of seed 1, by kinds of land in turn: mountains, coast, plains, desert, forest,
// hills.
constexpr std::array<ChunkPos, 24> kPlaces = {
    {{-1824, -1920}, {-1344, -2304}, {-1056, -2112}, {-1536, -2208}, {-2112, -2304}, {0, -2208},
     {-1344, -672},  {96, -2304},    {-1920, -2016}, {-1632, -2112}, {-2208, -2304}, {-1056, -2208},
     {-96, 1344},    {-1632, -2208}, {576, -1920},   {-1056, -768},  {-1056, -1440}, {-1056, -192},
     {768, 1536},    {-1056, -1536}, {1632, -1536},  {-1056, 864},   {-288, -2304},  {-2208, -2208}}};

// Microseconds of CPU time per chunk of a new generator, the minimum of some rounds.
double costOf(const std::string& name, world::Heights heights, int level) {
    constexpr int kRounds = 3, kTiles = 24;
    double best = 1e9;
    for (int round = 0; round < kRounds; ++round) {
        const gen::Generator generator(
            bench::orExit(gen::makeGenerator(name, bench::blocks(), {level, heights})), 1);
        const std::clock_t start = std::clock();
        for (int k = 0; k < kTiles * kTiles; ++k) {
            static_cast<void>(generator.generate({k % kTiles, k / kTiles, static_cast<std::uint8_t>(level)}));
        }
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        best = std::min(best, seconds * 1e6 / (kTiles * kTiles));
    }
    return best;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "overworld";
    const int places = std::clamp(argc > 2 ? std::atoi(argv[2]) : 24, 1, static_cast<int>(kPlaces.size()));
    const auto heights = bench::orExit(gen::heightsOf(name, bench::blocks(), {}, gen::builtInGenerators()));
    const double chunkCost = costOf(name, heights, 0);
    fmt::print("level  us a chunk  of level 0\n");
    for (int level = 0; level <= 10; ++level) {
        const double cost = level == 0 ? chunkCost : costOf(name, heights, level);
        fmt::print("{:5}  {:10.1f}  {:10.3f}\n", level, cost, cost / chunkCost);
    }
    const gen::LevelGenerators generators(
        [&](int level) {
            return gen::makeGenerator(name, bench::blocks(), {level, heights});
        },
        1, heights);
    const bench::LevelComparison comparison(generators, bench::blocks(),
                                            {kSide, {kPlaces.begin(), kPlaces.begin() + places}});
    std::vector<bench::LevelFigures> figures;
    for (int level = 1; level <= kFigureLevels; ++level) figures.push_back(comparison.of(level));
    fmt::print("\n{}\nheight of tiles less that of chunks, blocks\n{}", bench::coverTable(figures),
               bench::landTable(figures));
    return 0;
}
