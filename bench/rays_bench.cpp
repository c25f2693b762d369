// Rays through land to the horizon: how many a second on one core, what the cells of chunks take, what an
// edit costs. Arguments: the view distance and the horizon, in chunks.
#include <benchmark/benchmark.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/base/job_system.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/rays/cast.h"
#include "terrane/rays/scene.h"
#include "terrane/stream/tile_pipeline.h"
#include "terrane/stream/tile_table.h"

namespace {

using namespace terrane;
using shared::Ray, shared::RayHit;

constexpr int kDetail = 12;
constexpr glm::ivec2 kSize{320, 180};
constexpr float kEnd = 1e9f;

// The chunks and tiles that a session shows when all is loaded.
std::vector<world::ChunkPos> shownTiles(int viewDistance, int horizon) {
    const stream::TileView view{{0, 0}, viewDistance, horizon, kDetail};
    stream::TileTable table;
    stream::setTileView(table, view);
    for (const world::ChunkPos chunk : world::chunksWithin(view.center, viewDistance))
        stream::setChunkReady(table, chunk, true);
    std::vector<world::ChunkPos> shown;
    stream::updateTiles(table);
    while (stream::missingTiles(table) > 0) {
        for (const world::ChunkPos tile : stream::popTileRequests(table, 1000))
            stream::finishTile(table, tile);
        stream::updateTiles(table);
    }
    for (const auto& [pos, record] : table.records)
        if (record.isShown) shown.push_back(pos);
    std::sort(shown.begin(), shown.end());
    return shown;
}

struct Land {
    std::vector<world::ChunkPos> tiles;
    std::vector<world::Chunk> chunks;
    rays::StopTable stops;
    rays::Scene scene;
    std::vector<Ray> primary, shadow, diffuse;
    std::size_t chunkBytes = 0;

    const world::Chunk& chunkAt(world::ChunkPos pos) const {
        return chunks[static_cast<std::size_t>(std::lower_bound(tiles.begin(), tiles.end(), pos) -
                                               tiles.begin())];
    }
};

int groundAt(const Land& land, int x, int y) {
    const world::Chunk& chunk = land.chunkAt({x >> 4, y >> 4});
    int z = chunk.heights().top;
    while (z > chunk.heights().bottom && chunk.block(world::blockIndex(x & 15, y & 15, z - 1)) == world::kAir)
        --z;
    return z;
}

// Images of cameras near the ground and high above it that look around, in squares of 8×8 pixels. From the
// faces that they hit and that look toward the sun, rays to the sun; from all that they hit, random ones.
void addRays(Land& land) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    const float scale = std::tan(glm::radians(70.f) / 2) * 2 / static_cast<float>(kSize.y);
    for (int camera = 0; camera < 6; ++camera) {
        const int above[] = {1, 1, 4, 16, 50, 150};
        const int x = 7 * camera - 20, y = 11 * camera - 30;
        const float yaw = glm::radians(60.f * static_cast<float>(camera)),
                    pitch = glm::radians(camera < 4 ? -5.f : -15.f);
        const glm::ivec4 cell{x, y, groundAt(land, x, y) + above[camera], 0};
        const glm::vec3 look{std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                             std::sin(pitch)};
        const glm::vec3 right{std::sin(yaw), -std::cos(yaw), 0}, up = glm::cross(right, look);
        for (int k = 0; k < kSize.x * kSize.y; ++k) {
            const int square = k / 64, row = square / (kSize.x / 8), column = square % (kSize.x / 8);
            const glm::vec2 pixel{8 * column + k % 8, 8 * row + k / 8 % 8};
            const glm::vec2 at = (pixel + .5f - glm::vec2(kSize) / 2.f) * scale;
            land.primary.push_back(
                shared::makeRay(cell, {.5f, .5f, .6f, 0},
                                glm::vec4(glm::normalize(look + right * at.x - up * at.y), 0), kEnd));
        }
    }
    const glm::vec4 sun(glm::normalize(glm::vec3(.6f, .35f, .5f)), 0);
    std::vector<RayHit> hits(land.primary.size());
    rays::castRays(rays::raysThrough(land.scene), land.primary, hits);
    for (std::size_t k = 0; k < hits.size(); ++k) {
        const RayHit& hit = hits[k];
        if (hit.face >= shared::kRayFaceNone) continue;
        const int axis = static_cast<int>(hit.face / 2);
        const float side = hit.face % 2 == 0 ? -1 : 1;
        if (sun[axis] * side > 0) land.shadow.push_back(shared::rayFromFace(land.primary[k], hit, sun, kEnd));
        // Cosine-weighted around the normal.
        const float turn = unit(random) * 2 * glm::pi<float>(), share = unit(random);
        glm::vec4 direction(0);
        direction[(axis + 1) % 3] = std::cos(turn) * std::sqrt(share);
        direction[(axis + 2) % 3] = std::sin(turn) * std::sqrt(share);
        direction[axis] = side * std::sqrt(1 - share);
        land.diffuse.push_back(shared::rayFromFace(land.primary[k], hit, direction, kEnd));
    }
}

Land& landOf(const std::string& generator, int viewDistance, int horizon) {
    static std::map<std::string, std::unique_ptr<Land>> lands;
    std::unique_ptr<Land>& land =
        lands[generator + std::to_string(viewDistance) + "/" + std::to_string(horizon)];
    if (land) return *land;
    land = std::make_unique<Land>();
    land->tiles = shownTiles(viewDistance, horizon);
    const gen::LevelGenerators generators =
        bench::orExit(gen::makeLevelGenerators(generator, bench::blocks(), 1));
    land->chunks.resize(land->tiles.size());
    base::JobSystem jobs(2);
    const auto done = base::parallelFor(jobs, land->tiles.size(), [&](std::size_t k) {
        land->chunks[k] = generators.generate(land->tiles[k]);
        if (land->tiles[k].level > 0) stream::raiseDeepFloor(land->chunks[k], bench::blocks());
    });
    if (!done) std::exit(1);
    land->stops =
        rays::stopTable(bench::blocks(), [](const world::BlockType& type) { return type.id != world::kAir; });
    int levels = 1;
    for (const world::ChunkPos tile : land->tiles) levels = std::max(levels, 1 + tile.level);
    land->scene = rays::makeScene(generators.heights(), levels, viewDistance > 30 ? 7 : 6);
    for (std::size_t k = 0; k < land->tiles.size(); ++k) {
        rays::setTile(land->scene, land->tiles[k], rays::buildColumn(land->chunks[k], land->stops));
        land->chunkBytes += land->chunks[k].memoryBytes();
    }
    addRays(*land);
    return *land;
}

std::string digestOf(std::span<const RayHit> hits) {
    base::Digest digest;
    for (const RayHit& hit : hits) {
        const std::array<std::uint32_t, 6> words{hit.face,
                                                 shared::floatBitsToUint(hit.t),
                                                 static_cast<std::uint32_t>(hit.cell.x),
                                                 static_cast<std::uint32_t>(hit.cell.y),
                                                 static_cast<std::uint32_t>(hit.cell.z),
                                                 static_cast<std::uint32_t>(hit.level)};
        digest.update(std::as_bytes(std::span(words)).first(hit.face == shared::kRayMiss ? 4 : 24));
    }
    return digest.hex();
}

void cast(benchmark::State& state, const std::string& generator, std::vector<Ray> Land::*kind) {
    Land& land = landOf(generator, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const std::vector<Ray>& rays = land.*kind;
    std::vector<RayHit> hits(rays.size());
    for (auto _ : state) rays::castRays(rays::raysThrough(land.scene), rays, hits);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
    const auto misses = std::count_if(hits.begin(), hits.end(),
                                      [](const RayHit& hit) { return hit.face == shared::kRayMiss; });
    state.counters["miss_share"] = static_cast<double>(misses) / static_cast<double>(hits.size());
    double distance = 0;
    for (const RayHit& hit : hits) distance += hit.face == shared::kRayMiss ? 0 : hit.t;
    state.counters["mean_t"] =
        distance / static_cast<double>(static_cast<std::int64_t>(hits.size()) - misses);
    state.SetLabel(digestOf(hits).substr(0, 8));
}

// The cells of all chunks and tiles, and the bytes of a tile beside those of its chunk.
void build(benchmark::State& state, const std::string& generator) {
    Land& land = landOf(generator, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    for (auto _ : state)
        for (const world::Chunk& chunk : land.chunks)
            benchmark::DoNotOptimize(rays::buildColumn(chunk, land.stops));
    const auto tiles = static_cast<double>(land.tiles.size());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(land.tiles.size()));
    state.counters["tiles"] = tiles;
    state.counters["bytes_a_tile"] = static_cast<double>(4 * land.scene.wordsInUse) / tiles;
    state.counters["chunk_bytes"] = static_cast<double>(land.chunkBytes) / tiles;
    state.counters["MiB"] = static_cast<double>(rays::memoryBytes(land.scene)) / (1 << 20);
}

// One block at the ground, near and far from the camera.
void edit(benchmark::State& state, const std::string& generator) {
    Land& land = landOf(generator, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    std::mt19937 random(1);
    rays::SectionCells cells;
    world::BlockId id = bench::blockId("stone");
    for (auto _ : state) {
        state.PauseTiming();
        const int side = 16 * static_cast<int>(state.range(0));
        const int x = static_cast<int>(random() % static_cast<unsigned>(2 * side)) - side;
        const int y = static_cast<int>(random() % static_cast<unsigned>(2 * side)) - side;
        const int z = std::min(groundAt(land, x, y), land.scene.heights.top - 1);
        const world::ChunkPos pos{x >> 4, y >> 4};
        world::Chunk chunk = land.chunkAt(pos);
        chunk.setBlock(world::blockIndex(x & 15, y & 15, z), id);
        state.ResumeTiming();
        rays::buildCells(cells, chunk.section(z >> 4), land.stops);
        rays::setSection(land.scene, pos, z >> 4, cells);
        state.PauseTiming();
        rays::setTile(land.scene, pos, rays::buildColumn(land.chunkAt(pos), land.stops));
        state.ResumeTiming();
    }
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string generator : {"continents", "wilderness"}) {
        const auto add = [&](const char* name, auto run) {
            benchmark::RegisterBenchmark((name + ("/" + generator)).c_str(), run)
                ->Args({4, 16})
                ->Args({16, 1024})
                ->Args({32, 4096})
                ->Unit(benchmark::kMillisecond);
        };
        add("primary", [=](benchmark::State& state) { cast(state, generator, &Land::primary); });
        add("shadow", [=](benchmark::State& state) { cast(state, generator, &Land::shadow); });
        add("diffuse", [=](benchmark::State& state) { cast(state, generator, &Land::diffuse); });
        add("build", [=](benchmark::State& state) { build(state, generator); });
        add("edit", [=](benchmark::State& state) { edit(state, generator); });
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
