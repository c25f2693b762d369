// Light on one thread, over the landscape scene with a view distance of 16, and over worlds of −1,024…1,023
// with the same content or deep shafts. Labels are digests of the light of 0…255: they change where the
// result does, and are the same in the tall worlds.
#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scene_chunks.h"
#include "terrane/light/light_area.h"
#include "terrane/light/relight.h"
#include "terrane/shared/hash.h"
#include "tests/support/default_heights.h"

namespace {

using namespace terrane;
using bench::blockId;
using bench::blocks;
using bench::orExit;
using light::ChunkLight;
using light::LocalLight;

using bench::kSide;

const light::LightTable& table() {
    static const light::LightTable result(blocks());
    return result;
}

const std::vector<world::Chunk>& landscape() {
    static const std::vector<world::Chunk> chunks = bench::sceneChunks("landscape");
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
            light::LocalLightNeighborhood around;
            for (int k = 0; k < 9; ++k) {
                around[static_cast<std::size_t>(k)] =
                    &locals[static_cast<std::size_t>(x + k % 3 - 1 + kSide * (y + k / 3 - 1))];
            }
            lights.push_back(lightChunk(around, scratch));
        }
    }
    return lights;
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

void neighbors(benchmark::State& state) {
    light::LightScratch scratch;
    const std::vector<LocalLight> locals = solveAll(landscape(), scratch);
    std::vector<ChunkLight> lights;
    for (auto _ : state) lights = lightAll(locals, scratch);
    std::size_t bytes = 0;
    for (const ChunkLight& chunk : lights) bytes += chunk.memoryBytes();
    state.counters["time/chunk"] = perChunk(kLit);
    state.counters["bytes"] = static_cast<double>(bytes) / kLit;
    state.SetLabel(bench::digestOf(lights));
}

std::vector<ChunkLight> lightEverything(const std::vector<world::Chunk>& chunks, int side) {
    light::LightArea area{side, side, {}};
    for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
    return lightArea(area, table());
}

// Both stages, one thread.
void lightScene(benchmark::State& state, const std::vector<world::Chunk>& chunks) {
    std::vector<ChunkLight> lights;
    for (auto _ : state) lights = lightEverything(chunks, kSide);
    std::size_t bytes = 0;
    for (const ChunkLight& chunk : lights) bytes += chunk.memoryBytes();
    state.counters["time/chunk"] = perChunk(chunks.size());
    state.counters["bytes"] = static_cast<double>(bytes) / static_cast<double>(chunks.size());
    state.SetLabel(bench::digestOf(lights));
}

void landscapeScene(benchmark::State& state) {
    lightScene(state, landscape());
}
constexpr world::Heights kTall{-1024, 1024};

// The chunks with rock below and sky above them.
std::vector<world::Chunk> inTallWorld(const std::vector<world::Chunk>& chunks) {
    std::vector<world::Chunk> tall;
    for (const world::Chunk& chunk : chunks) {
        world::Chunk& copy = tall.emplace_back(kTall);
        for (int n = kTall.firstSection(); n < 0; ++n) copy.setSection(n, world::Section(blockId("stone")));
        for (int n = 0; n < world::kSectionsPerChunk; ++n) copy.setSection(n, chunk.section(n));
    }
    return tall;
}

void tallLandscapeScene(benchmark::State& state) {
    lightScene(state, inTallWorld(landscape()));
}
void tallOceanScene(benchmark::State& state) {
    lightScene(state, inTallWorld(bench::sceneChunks("ocean")));
}
void tallCaveScene(benchmark::State& state) {
    lightScene(state, inTallWorld(bench::sceneChunks("cave")));
}
void oceanScene(benchmark::State& state) {
    lightScene(state, bench::sceneChunks("ocean"));
}
void caveScene(benchmark::State& state) {
    lightScene(state, bench::sceneChunks("cave"));
}

// Lamps of four colors on the ground or on what grows there, at random places.
void tenThousandLamps(benchmark::State& state) {
    std::vector<world::Chunk> chunks = landscape();
    const std::array lamps = {blockId("lamp_white"), blockId("lamp_red"), blockId("lamp_green"),
                              blockId("lamp_blue")};
    for (unsigned k = 0; k < 10'000; ++k) {
        const unsigned hash = shared::hash3(k, 0u, 0u, 1u);
        world::Chunk& chunk = chunks[hash % chunks.size()];
        const int x = static_cast<int>(hash >> 16 & 15), y = static_cast<int>(hash >> 20 & 15);
        int z = world::kChunkHeight - 1;
        while (z > 0 && chunk.block(world::blockIndex(x, y, z - 1)) == world::kAir) --z;
        chunk.setBlock(world::blockIndex(x, y, z), lamps[k % lamps.size()]);
    }
    lightScene(state, chunks);
}

// Worst edits, in 3×3 chunks: each iteration makes an edit and takes it back, and both are relit.

struct TestScene {
    explicit TestScene(world::Heights heights = {}) : chunks(9, world::Chunk(heights)) {}

    // Blocks of the box, x and y from the corner of the area, ends excluded.
    void fill(world::BlockPos from, world::BlockPos to, world::BlockId id) {
        for (int z = from.z; z < to.z; ++z) {
            for (int y = from.y; y < to.y; ++y) {
                for (int x = from.x; x < to.x; ++x) set(x, y, z, id);
            }
        }
    }
    void set(int x, int y, int z, world::BlockId id) {
        chunks[static_cast<std::size_t>(x / 16 + 3 * (y / 16))].setBlock(world::blockIndex(x & 15, y & 15, z),
                                                                         id);
    }

    std::vector<world::Chunk> chunks;
};

// Open ground at z = 100, or at `top`.
TestScene openGround(world::Heights heights = {}, int top = 100) {
    TestScene scene(heights);
    scene.fill({0, 0, heights.bottom}, {48, 48, top}, blockId("stone"));
    return scene;
}

// Stone up to z = 967 with glowing ore and caves, which take this percentage of it.
TestScene deepCaves(benchmark::State& state) {
    const auto open = static_cast<unsigned>(state.range(0));
    TestScene scene = openGround(kTall, 967);
    for (int z = kTall.bottom; z < 967; ++z) {
        for (int k = 0; k < 48 * 48; ++k) {
            const auto x = static_cast<unsigned>(k % 48), y = static_cast<unsigned>(k / 48);
            const auto up = static_cast<unsigned>(z - kTall.bottom);
            if (shared::hash3(x / 4, y / 4, up / 4, 1u) % 100 < open) {
                scene.set(k % 48, k / 48, z, world::kAir);
            } else if (shared::hash3(x, y, up, 2u) % 200 == 0) {
                scene.set(k % 48, k / 48, z, blockId("glowing_ore"));
            }
        }
    }
    return scene;
}

// A cave of 46×46 blocks from z = 100 to `top` under a roof of two.
TestScene cave(int top) {
    TestScene scene;
    scene.fill({0, 0, 0}, {48, 48, top + 2}, blockId("stone"));
    scene.fill({1, 1, 100}, {47, 47, top}, world::kAir);
    return scene;
}

// A tree-covered ground: leaves in two layers of three blocks with gaps.
TestScene underLeaves() {
    TestScene scene = openGround();
    scene.fill({0, 0, 104}, {48, 48, 107}, blockId("oak_leaves"));
    for (int k = 0; k < 48; k += 3) scene.fill({k, 0, 104}, {k + 1, 48, 107}, world::kAir);
    return scene;
}

// Changes the block at `index` of the middle chunk between two ids.
void edit(benchmark::State& state, TestScene scene, world::BlockIndex index, world::BlockId first,
          world::BlockId second) {
    light::LightScratch scratch;
    scene.chunks[4].setBlock(index, first);
    light::LightWindow window;
    const std::vector<ChunkLight> lights = lightEverything(scene.chunks, 3);
    for (std::size_t k = 0; k < 9; ++k) {
        window.chunks[k] = &scene.chunks[k];
        window.lights[k] = std::make_shared<ChunkLight>(lights[k]);
    }
    const auto change = [&](world::BlockId from, world::BlockId to) {
        scene.chunks[4].setBlock(index, to);
        const light::BlockChange one{index, from};
        const auto bricks = relight(window, {&one, 1}, table(), scratch);
        int changed = 0;
        for (const world::SectionSet& set : bricks) changed += static_cast<int>(set.count());
        return changed;
    };
    int bricks = 0;
    for (auto _ : state) {
        bricks = change(first, second);
        state.PauseTiming();  // the way back is another benchmark
        change(second, first);
        state.ResumeTiming();
    }
    state.counters["bricks"] = bricks;
}

void lampRemoved(benchmark::State& state) {
    edit(state, openGround(), world::blockIndex(8, 8, 104), blockId("lamp_white"), world::kAir);
}
void lampPlaced(benchmark::State& state) {
    edit(state, openGround(), world::blockIndex(8, 8, 104), world::kAir, blockId("lamp_white"));
}
void lampRemovedInCorner(benchmark::State& state) {
    edit(state, openGround(), world::blockIndex(15, 15, 111), blockId("lamp_white"), world::kAir);
}

// At the surface of a tall world, at z = 100 or 900, and in a cave at z = −892.
void tallLampPlaced(benchmark::State& state) {
    const int z = static_cast<int>(state.range(0));
    TestScene scene = openGround(kTall, z < 0 ? 100 : z);
    if (z < 0) scene.fill({1, 1, z}, {47, 47, z + 8}, world::kAir);
    edit(state, std::move(scene), world::blockIndex(8, 8, z + 4), world::kAir, blockId("lamp_white"));
}
void tallLampRemoved(benchmark::State& state) {
    const int z = static_cast<int>(state.range(0));
    TestScene scene = openGround(kTall, z < 0 ? 100 : z);
    if (z < 0) scene.fill({1, 1, z}, {47, 47, z + 8}, world::kAir);
    edit(state, std::move(scene), world::blockIndex(8, 8, z + 4), blockId("lamp_white"), world::kAir);
}

// A shaft of 1×1×1,990 blocks to the bottom of the world, or a hall of 46×46×1,900, under a lid.
void editShaft(benchmark::State& state, TestScene scene, std::string_view before, std::string_view after) {
    const auto idOf = [](std::string_view name) { return name.empty() ? world::kAir : blockId(name); };
    scene.fill({24, 24, kTall.bottom}, {25, 25, 967}, world::kAir);
    scene.fill({23, 23, 966}, {26, 26, 967}, blockId("stone"));
    edit(state, std::move(scene), world::blockIndex(8, 8, 966), idOf(before), idOf(after));
}
TestScene deepHall() {
    TestScene scene = openGround(kTall, 967);
    scene.fill({1, 1, 66 - 1024}, {47, 47, 942}, world::kAir);
    return scene;
}
void shaftOpened(benchmark::State& state) {
    editShaft(state, openGround(kTall, 967), "stone", "");
}
void shaftClosed(benchmark::State& state) {
    editShaft(state, openGround(kTall, 967), "", "stone");
}
void shaftInCavesOpened(benchmark::State& state) {
    editShaft(state, deepCaves(state), "stone", "");
}
void shaftInCavesClosed(benchmark::State& state) {
    editShaft(state, deepCaves(state), "", "stone");
}
void deepHallOpened(benchmark::State& state) {
    editShaft(state, deepHall(), "stone", "");
}
void deepHallClosed(benchmark::State& state) {
    editShaft(state, deepHall(), "", "stone");
}

// The roof's lower block is open already, so that the edit lets daylight in or takes it away.
void editRoof(benchmark::State& state, int top, std::string_view before, std::string_view after) {
    const auto idOf = [](std::string_view name) { return name.empty() ? world::kAir : blockId(name); };
    TestScene scene = cave(top);
    scene.fill({24, 24, top}, {25, 25, top + 1}, world::kAir);
    edit(state, scene, world::blockIndex(8, 8, top + 1), idOf(before), idOf(after));
}
void roofOpened(benchmark::State& state) {
    editRoof(state, static_cast<int>(state.range(0)), "stone", "");
}
void roofClosed(benchmark::State& state) {
    editRoof(state, static_cast<int>(state.range(0)), "", "stone");
}
void leafRemoved(benchmark::State& state) {
    edit(state, underLeaves(), world::blockIndex(8, 8, 106), blockId("oak_leaves"), world::kAir);
}
void stonePlaced(benchmark::State& state) {
    edit(state, openGround(), world::blockIndex(8, 8, 100), world::kAir, blockId("stone"));
}

BENCHMARK(landscapeScene)->Unit(benchmark::kMillisecond);
BENCHMARK(oceanScene)->Unit(benchmark::kMillisecond);
BENCHMARK(caveScene)->Unit(benchmark::kMillisecond);
BENCHMARK(tenThousandLamps)->Unit(benchmark::kMillisecond);
BENCHMARK(local)->Unit(benchmark::kMillisecond);
BENCHMARK(neighbors)->Unit(benchmark::kMillisecond);
BENCHMARK(lampRemoved)->Unit(benchmark::kMicrosecond);
BENCHMARK(lampPlaced)->Unit(benchmark::kMicrosecond);
BENCHMARK(lampRemovedInCorner)->Unit(benchmark::kMicrosecond);
BENCHMARK(roofOpened)->Arg(130)->Arg(160)->Arg(250)->Unit(benchmark::kMicrosecond);
BENCHMARK(roofClosed)->Arg(130)->Arg(160)->Arg(250)->Unit(benchmark::kMicrosecond);
BENCHMARK(leafRemoved)->Unit(benchmark::kMicrosecond);
BENCHMARK(stonePlaced)->Unit(benchmark::kMicrosecond);
BENCHMARK(tallLandscapeScene)->Unit(benchmark::kMillisecond);
BENCHMARK(tallOceanScene)->Unit(benchmark::kMillisecond);
BENCHMARK(tallCaveScene)->Unit(benchmark::kMillisecond);
BENCHMARK(tallLampPlaced)->Arg(100)->Arg(900)->Arg(-892)->Unit(benchmark::kMicrosecond);
BENCHMARK(tallLampRemoved)->Arg(100)->Arg(900)->Arg(-892)->Unit(benchmark::kMicrosecond);
BENCHMARK(shaftOpened)->Unit(benchmark::kMicrosecond);
BENCHMARK(shaftClosed)->Unit(benchmark::kMicrosecond);
BENCHMARK(shaftInCavesOpened)->Arg(8)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(shaftInCavesClosed)->Arg(8)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(deepHallOpened)->Unit(benchmark::kMicrosecond);
BENCHMARK(deepHallClosed)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
