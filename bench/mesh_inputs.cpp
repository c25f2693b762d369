#include "bench/mesh_inputs.h"

#include <array>
#include <cmath>

#include "bench/bench_content.h"
#include "terrane/content/built_in.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/language/builder.h"
#include "terrane/shared/hash.h"
#include "tests/support/default_heights.h"

namespace terrane::bench {
namespace {

using world::BlockId;
using world::ChunkPos;

unsigned hashAt(int x, int y, int z) {
    return shared::hash3(static_cast<unsigned>(x), static_cast<unsigned>(y), static_cast<unsigned>(z), 1);
}

// f(chunk position) for each chunk of a square around `middle`.
template <class F>
MeshWorld makeWorld(ChunkPos middle, F f) {
    std::vector<world::Chunk> chunks;
    for (int y = -1; y <= kGrid; ++y) {
        for (int x = -1; x <= kGrid; ++x) {
            chunks.push_back(f(ChunkPos{middle.x - kGrid / 2 + x, middle.y - kGrid / 2 + y}));
        }
    }
    return MeshWorld(std::move(chunks));
}

// blockAt(x, y, z) in the world.
template <class F>
MeshWorld fromBlocks(F blockAt) {
    return makeWorld({}, [&](ChunkPos pos) {
        world::Chunk chunk;
        std::array<BlockId, world::kBlocksPerSection> values;
        for (int number = 0; number < world::kSectionsPerChunk; ++number) {
            for (int i = 0; i < world::kBlocksPerSection; ++i) {
                const int x = 16 * pos.x + (i & 15), y = 16 * pos.y + (i >> 4 & 15),
                          z = 16 * number + (i >> 8);
                values[static_cast<std::size_t>(i)] = blockAt(x, y, z);
            }
            chunk.setSection(number, world::Section::fromValues(values));
        }
        return chunk;
    });
}

MeshWorld fromGenerator(gen::GeneratorGraph graph, ChunkPos middle) {
    const gen::Generator generator(std::move(graph), 1);
    return makeWorld(middle, [&](ChunkPos pos) { return generator.generate(pos); });
}

// Around the camera of a reference scene.
template <std::size_t kScene>
MeshWorld scene() {
    return fromGenerator(orExit(gen::makeGenerator("overworld", blocks())),
                         world::chunkOf(content::scenes()[kScene].pose.position));
}

constexpr int kSeaLevel = 80;

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
    if (ground <= kSeaLevel + 2 || hashAt(x >> 3, y >> 3, 2) % 3 == 0) return world::kAir;
    const int dx = x - treeX, dy = y - treeY, dz = z - ground - 5;
    if (dx == 0 && dy == 0 && dz < 0 && dz >= -5) return blockId("oak_log");
    return dx * dx + dy * dy + dz * dz <= 7 && hashAt(x, y, z) % 8 != 0 ? blockId("oak_leaves") : world::kAir;
}

bool isCave(int x, int y, int z) {
    const float fx = static_cast<float>(x), fy = static_cast<float>(y), fz = static_cast<float>(z);
    return z < 60 && std::sin(fx / 6) + std::sin(fy / 7) + std::sin(fz / 5) > 1.9f;
}

// Hills, sea, caves, ore, trees, plants.
BlockId terrainAt(int x, int y, int z) {
    const int height = heightAt(x, y);
    if (z < height - 4) {
        if (isCave(x, y, z)) return world::kAir;
        return hashAt(x / 2, y / 2, z / 2) % 200 == 0 ? blockId("glowing_ore") : blockId("stone");
    }
    const bool beach = height < kSeaLevel + 3;
    if (z < height - 1) return beach ? blockId("sand") : blockId("dirt");
    if (z < height) return beach ? blockId("sand") : blockId("grass");
    if (z < kSeaLevel) return blockId("water");
    if (const BlockId tree = treeAt(x, y, z); tree != world::kAir) return tree;
    return z == height && !beach && hashAt(x, y, z) % 9 == 0 ? blockId("grass_tuft") : world::kAir;
}

MeshWorld terrain() {
    return fromBlocks(terrainAt);
}

// The terrain in a world of 4,096 layers: stone below, air above.
MeshWorld tallTerrain() {
    constexpr world::Heights kTall{world::kLowestBottom, world::kHighestTop};
    std::vector<world::Chunk> chunks;
    for (const world::Chunk& low : terrain().chunks) {
        world::Chunk& chunk = chunks.emplace_back(kTall);
        for (int number = kTall.firstSection(); number < low.heights().firstSection(); ++number)
            chunk.setSection(number, world::Section(blockId("stone")));
        for (int number = low.heights().firstSection(); number < low.heights().endSection(); ++number)
            chunk.setSection(number, low.section(number));
    }
    return MeshWorld(std::move(chunks));
}

// Nothing but ground of four types.
MeshWorld perlinHills() {
    gen::GeneratorBuilder builder("hills", blocks());
    builder.pass3D("ground", [](gen::Pass& p) {
        const gen::Float height =
            gen::Float(96) + gen::Float(40) * p.perlin2D("hills", 8, {0.1f, 0.2f, 0.4f, 0.8f});
        const gen::Float depth = height - gen::Float(p.z());
        gen::Block block = select(depth > gen::Float(4), p.block("stone"), p.block("dirt"));
        block = select(depth < gen::Float(1), p.block("grass"), block);
        block = select(height < gen::Float(88), p.block("sand"), block);
        p.setBlock(select(depth > gen::Float(0), block, p.block("air")));
    });
    return fromGenerator(orExit(builder.finish()), {});
}

// 56 % solid, five types, all 256 blocks high.
MeshWorld perlinCaves() {
    gen::GeneratorBuilder builder("caves", blocks());
    builder.pass3D("ground", [](gen::Pass& p) {
        const gen::Float kind = p.perlin3D("kind", 16, {1});
        gen::Block block = select(kind < gen::Float(-0.25f), p.block("dirt"), p.block("stone"));
        block = select(kind > gen::Float(0.1f), p.block("sand"), block);
        block = select(kind > gen::Float(0.25f), p.block("snow"), block);
        block = select(kind > gen::Float(0.35f), p.block("glowing_ore"), block);
        p.setBlock(select(p.perlin3D("caves", 8, {0.5f, 1}) > gen::Float(-0.05f), block, p.block("air")));
    });
    return fromGenerator(orExit(builder.finish()), {});
}

MeshWorld random(const std::array<std::string_view, 4>& names) {
    std::array<BlockId, 4> ids;
    for (std::size_t k = 0; k < 4; ++k) ids[k] = blockId(names[k]);
    return fromBlocks([=](int x, int y, int z) {
        const unsigned hash = hashAt(x, y, z);
        return hash % 2 == 0 ? world::kAir : ids[hash / 2 % 4];
    });
}

MeshWorld randomCubes() {
    return random({"stone", "dirt", "grass", "sand"});
}
MeshWorld randomKinds() {
    return random({"stone", "oak_leaves", "water", "cyan_glass"});
}
MeshWorld checkerboard() {
    return fromBlocks([stone = blockId("stone")](int x, int y, int z) {
        return (x + y + z) % 2 == 0 ? stone : world::kAir;
    });
}
MeshWorld empty() {
    return fromBlocks([](int, int, int) { return world::kAir; });
}
MeshWorld allStone() {
    return fromBlocks([stone = blockId("stone")](int, int, int) { return stone; });
}

constexpr std::array kInputs = {NamedInput{"ocean", scene<0>},
                                NamedInput{"desert", scene<1>},
                                NamedInput{"landscape", scene<2>},
                                NamedInput{"cave", scene<3>},
                                NamedInput{"terrain", terrain},
                                NamedInput{"tall_terrain", tallTerrain},
                                NamedInput{"perlin_hills", perlinHills},
                                NamedInput{"perlin_caves", perlinCaves},
                                NamedInput{"random_cubes", randomCubes},
                                NamedInput{"random_kinds", randomKinds},
                                NamedInput{"checkerboard", checkerboard},
                                NamedInput{"empty", empty},
                                NamedInput{"all_stone", allStone}};

}  // namespace

std::vector<mesh::MeshInput> MeshWorld::inputs(const mesh::MeshOptions& options) const {
    constexpr std::size_t kRow = kGrid + 2;
    std::vector<mesh::MeshInput> result;
    for (std::size_t y = 1; y <= kGrid; ++y) {
        for (std::size_t x = 1; x <= kGrid; ++x) {
            const world::Chunk* middle = &chunks[y * kRow + x];
            result.push_back(
                {middle, {middle - 1, middle + 1, middle - kRow, middle + kRow}, &blocks(), options});
        }
    }
    return result;
}

std::span<const NamedInput> meshInputs() {
    return kInputs;
}

}  // namespace terrane::bench
