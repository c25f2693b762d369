// Meshing of whole chunks on one thread. The label is a digest of all quads: it changes where the result
// does.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/base/digest.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/shared/hash.h"
#include "terrane/world/block_registry.h"

namespace {

using namespace terrane;
using world::BlockId;

// Ids follow the order: stone is 1.
constexpr std::string_view kBlocks = R"(
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
[[block]]
name = "dirt"
shape = "cube"
texture = "dirt"
[[block]]
name = "grass"
shape = "cube"
textures = { top = "grass", bottom = "dirt", side = "grass_side" }
[[block]]
name = "sand"
shape = "cube"
texture = "sand"
[[block]]
name = "ore"
shape = "cube"
texture = "ore"
alpha = "glow"
[[block]]
name = "log"
shape = "cube"
textures = { top = "log_top", bottom = "log_top", side = "log" }
[[block]]
name = "leaves"
shape = "cube"
texture = "leaves"
alpha = "test"
two_sided = true
inner_faces = true
animation = "whole_waves"
opacity = 3
[[block]]
name = "tuft"
shape = "cross"
texture = "tuft"
alpha = "test"
two_sided = true
animation = "top_waves"
opacity = 3
[[block]]
name = "water"
shape = "liquid"
texture = "water"
alpha = "blend"
animation = "liquid_surface"
opacity = 1
[[block]]
name = "glass"
shape = "cube"
texture = "glass"
alpha = "blend"
two_sided = true
opacity = 3
)";
enum Id : BlockId { kAir, kStone, kDirt, kGrass, kSand, kOre, kLog, kLeaves, kTuft, kWater, kGlass };

constexpr int kSeaLevel = 80;
constexpr int kGrid = 8;  // chunks along x and y that are meshed, one row more around them

unsigned hashAt(int x, int y, int z) {
    return shared::hash3(static_cast<unsigned>(x), static_cast<unsigned>(y), static_cast<unsigned>(z), 1);
}

int heightAt(int x, int y) {
    const float fx = static_cast<float>(x), fy = static_cast<float>(y);
    const float hills = 14 * std::sin(fx / 23) + 11 * std::cos(fy / 31) + 4 * std::sin((fx + fy) / 9);
    return kSeaLevel + 4 + static_cast<int>(hills);
}

// One tree in most cells of 8×8 blocks: a trunk of 5 blocks, leaves in a ball of radius 2.7 with gaps.
BlockId treeAt(int x, int y, int z) {
    const int treeX = (x & ~7) + 3 + static_cast<int>(hashAt(x >> 3, y >> 3, 0) % 3);
    const int treeY = (y & ~7) + 3 + static_cast<int>(hashAt(x >> 3, y >> 3, 1) % 3);
    const int ground = heightAt(treeX, treeY);
    if (ground <= kSeaLevel + 2 || hashAt(x >> 3, y >> 3, 2) % 3 == 0) return kAir;
    const int dx = x - treeX, dy = y - treeY, dz = z - ground - 5;
    if (dx == 0 && dy == 0 && dz < 0 && dz >= -5) return kLog;
    return dx * dx + dy * dy + dz * dz <= 7 && hashAt(x, y, z) % 8 != 0 ? kLeaves : kAir;
}

bool isCave(int x, int y, int z) {
    const float fx = static_cast<float>(x), fy = static_cast<float>(y), fz = static_cast<float>(z);
    return z < 60 && std::sin(fx / 6) + std::sin(fy / 7) + std::sin(fz / 5) > 1.9f;
}

BlockId terrainAt(int x, int y, int z) {
    const int height = heightAt(x, y);
    if (z < height - 4) {
        if (isCave(x, y, z)) return kAir;
        return hashAt(x / 2, y / 2, z / 2) % 200 == 0 ? kOre : kStone;
    }
    const bool beach = height < kSeaLevel + 3;
    if (z < height - 1) return beach ? kSand : kDirt;
    if (z < height) return beach ? kSand : kGrass;
    if (z < kSeaLevel) return kWater;
    if (const BlockId tree = treeAt(x, y, z); tree != kAir) return tree;
    return z == height && !beach && hashAt(x, y, z) % 9 == 0 ? kTuft : kAir;
}

BlockId checkerboardAt(int x, int y, int z) {
    return (x + y + z) % 2 == 0 ? kStone : kAir;
}

BlockId randomAt(int x, int y, int z) {
    constexpr BlockId kTypes[] = {kStone, kLeaves, kWater, kGlass};
    const unsigned hash = hashAt(x, y, z);
    if (hash % 2 == 0) return kAir;
    return kTypes[hash / 2 % 4];
}

BlockId emptyAt(int, int, int) {
    return kAir;
}
BlockId stoneAt(int, int, int) {
    return kStone;
}

using Source = BlockId (*)(int x, int y, int z);

world::Chunk makeChunk(int chunkX, int chunkY, Source source) {
    world::Chunk chunk;
    std::vector<BlockId> values(world::kBlocksPerSection);
    for (int number = 0; number < world::kSectionsPerChunk; ++number) {
        for (int i = 0; i < world::kBlocksPerSection; ++i) {
            const int x = 16 * chunkX + (i & 15), y = 16 * chunkY + ((i >> 4) & 15),
                      z = 16 * number + (i >> 8);
            values[static_cast<std::size_t>(i)] = source(x, y, z);
        }
        const std::span<const BlockId, world::kBlocksPerSection> all(values);
        chunk.setSection(number, world::Section::fromValues(all));
    }
    return chunk;
}

struct Grid {
    explicit Grid(Source source) {
        for (int y = -1; y <= kGrid; ++y) {
            for (int x = -1; x <= kGrid; ++x) chunks.push_back(makeChunk(x, y, source));
        }
    }
    const world::Chunk* at(int x, int y) const {
        return &chunks[static_cast<std::size_t>((y + 1) * (kGrid + 2) + x + 1)];
    }
    std::vector<world::Chunk> chunks;
};

const world::BlockRegistry& blocks() {
    static const world::BlockRegistry registry = [] {
        auto parsed = world::BlockRegistry::parse(kBlocks, "blocks");
        if (!parsed) {
            std::fprintf(stderr, "%s\n", parsed.error().message.c_str());
            std::exit(1);
        }
        return std::move(*parsed);
    }();
    return registry;
}

std::vector<mesh::MeshInput> inputsOf(const Grid& grid) {
    std::vector<mesh::MeshInput> inputs;
    for (int y = 0; y < kGrid; ++y) {
        for (int x = 0; x < kGrid; ++x) {
            mesh::MeshInput input;
            input.centre = grid.at(x, y);
            input.neighbours = {grid.at(x - 1, y), grid.at(x + 1, y), grid.at(x, y - 1), grid.at(x, y + 1)};
            input.blocks = &blocks();
            inputs.push_back(input);
        }
    }
    return inputs;
}

// One iteration is one chunk.
void meshChunks(benchmark::State& state, Source source) {
    const Grid grid(source);
    const std::vector<mesh::MeshInput> inputs = inputsOf(grid);
    mesh::MeshScratch scratch;
    base::Digest digest;
    std::size_t quadCount = 0;
    for (const mesh::MeshInput& input : inputs) {
        const mesh::ChunkMesh mesh = meshChunk(input, scratch);
        digest.update(std::as_bytes(std::span(mesh.quads)));
        quadCount += mesh.quads.size();
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(meshChunk(inputs[next], scratch));
        next = (next + 1) % inputs.size();
    }
    state.counters["time/voxel"] = benchmark::Counter(
        world::kBlocksPerChunk, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["quads"] = static_cast<double>(quadCount) / static_cast<double>(inputs.size());
    state.SetLabel(digest.hex());
}

BENCHMARK_CAPTURE(meshChunks, terrain, terrainAt)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(meshChunks, checkerboard, checkerboardAt)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(meshChunks, random_half, randomAt)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(meshChunks, empty, emptyAt)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(meshChunks, all_stone, stoneAt)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
