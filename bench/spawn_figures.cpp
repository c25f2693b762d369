#include "bench/spawn_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "bench/bench_content.h"
#include "terrane/game/spawn.h"
#include "terrane/gen/generators/catalogue.h"

namespace terrane::bench {
namespace {

constexpr int kViewLevel = 4, kViewStep = 1 << kViewLevel, kViewTiles = 17;  // 2 km around a tile
constexpr int kViewSide = kViewTiles * 16, kFarthest = 2000, kRays = 128;

struct View {
    float seen = 0, relief = 0;
};

View viewFrom(const LandColumns& columns, const LandKind& kind, const glm::dvec3& eye) {
    const auto tileOf = [](double v) { return static_cast<int>(std::floor(v / (16 * kViewStep))); };
    const int firstX = tileOf(eye.x) - kViewTiles / 2, firstY = tileOf(eye.y) - kViewTiles / 2;
    const auto heights = columns.square({"height"}, firstX, firstY, kViewTiles)[0];
    const double left = firstX * 16.0 * kViewStep, top = firstY * 16.0 * kViewStep;
    double all = 0, seen = 0, lowest = eye.z, highest = kind.sea;
    for (int ray = 0; ray < kRays; ++ray) {
        const double angle = 2 * std::numbers::pi * ray / kRays;
        double horizon = -1e9;  // the largest slope so far
        for (int away = 2 * kViewStep; away <= kFarthest; away += kViewStep) {
            const auto x = static_cast<int>((eye.x + away * std::cos(angle) - left) / kViewStep);
            const auto y = static_cast<int>((eye.y + away * std::sin(angle) - top) / kViewStep);
            const float ground =
                std::max(gen::asFloat(heights[static_cast<std::size_t>(x + y * kViewSide)]), kind.sea);
            const double slope = (double{ground} - eye.z) / away;
            all += away;
            if (slope < horizon) continue;
            horizon = slope;
            seen += away;  // columns of a ray stand for more area farther away
            lowest = std::min(lowest, double{ground});
            highest = std::max(highest, double{ground});
        }
    }
    return {static_cast<float>(seen / all), static_cast<float>(highest - lowest)};
}

}  // namespace

void addSpawn(SpawnStatistics& s, const LandKind& kind, std::uint64_t seed) {
    const gen::Generator generator(orExit(gen::makeGenerator(kind.generator, blocks())), seed);
    const world::Pose spawn = game::findSpawn(generator, blocks());
    const world::BlockPos at = world::blockOf(spawn.position);
    const world::ChunkPos chunk = world::chunkOf(at);
    const auto biomes = LandColumns(kind, seed, 0).square({"biome"}, chunk.x, chunk.y, 1)[0];
    const auto biome = static_cast<int>(biomes[static_cast<std::size_t>((at.x & 15) + 16 * (at.y & 15))]);
    const View view = viewFrom(LandColumns(kind, seed, kViewLevel), kind, spawn.position);
    ++s.spawns;
    s.onLand += biome >= kind.firstLandBiome;
    s.seen.push_back(view.seen);
    s.relief.push_back(view.relief);
}

}  // namespace terrane::bench
