#include "examples/light_scenes.h"

#include <array>
#include <cmath>

#include "terrane/shared/hash.h"
#include "terrane/world/changes/block_edit.h"

namespace terrane::examples {
namespace {

using world::BlockId;
using world::BlockPos;
using world::BlockRegistry;
using world::World;

constexpr int kGround = 80;  // the lowest block of air
constexpr int kFirst = -16 * kSceneRadius, kEnd = 16 * (kSceneRadius + 1);

void put(World& world, const BlockRegistry& blocks, BlockPos pos, BlockId id) {
    std::vector<world::BlockEdit> edits;  // ignored: the world is not on screen yet
    world::applyChange(world, blocks, pos, world::SetBlock{id}, edits);
}

// Fills a box, the end excluded.
void fill(World& world, const BlockRegistry& blocks, BlockPos from, BlockPos to, BlockId id) {
    for (int z = from.z; z < to.z; ++z) {
        for (int y = from.y; y < to.y; ++y) {
            for (int x = from.x; x < to.x; ++x) put(world, blocks, {x, y, z}, id);
        }
    }
}

BlockId idOf(const BlockRegistry& blocks, std::string_view name) {
    return blocks.find(name)->id;
}

void buildGround(World& world, const BlockRegistry& blocks, std::string_view top) {
    fill(world, blocks, {kFirst, kFirst, kGround - 4}, {kEnd, kEnd, kGround - 1}, idOf(blocks, "stone"));
    fill(world, blocks, {kFirst, kFirst, kGround - 1}, {kEnd, kEnd, kGround}, idOf(blocks, top));
}

// A cave with uneven walls in solid stone, a lamp of each color on its floor.
void buildCave(World& world, const BlockRegistry& blocks) {
    fill(world, blocks, {kFirst, kFirst, 60}, {kEnd, kEnd, 110}, idOf(blocks, "stone"));
    for (int z = 70; z < 100; ++z) {
        for (int y = -22; y < 22; ++y) {
            for (int x = -22; x < 22; ++x) {
                const float u = static_cast<float>(x) / 15, v = static_cast<float>(y) / 17,
                            w = static_cast<float>(z - 81) / 8;
                const auto fx = static_cast<float>(x), fy = static_cast<float>(y), fz = static_cast<float>(z);
                const float bumps = 0.18f * std::sin(fx * 0.7f + fz * 0.3f) * std::sin(fy * 0.6f) +
                                    0.12f * std::sin(fz * 0.9f + fx);
                if (u * u + v * v + w * w + bumps < 1) put(world, blocks, {x, y, z}, world::kAir);
            }
        }
    }
    constexpr std::array kLamps = {"lamp_red", "lamp_green", "lamp_blue", "lamp_white"};
    constexpr std::array<std::array<int, 2>, 4> kPlaces = {{{-7, -3}, {6, -4}, {5, 6}, {-6, 7}}};
    for (std::size_t k = 0; k < kLamps.size(); ++k) {
        const auto [x, y] = kPlaces[k];
        int z = 84;
        while (world.block({x, y, z - 1}) == world::kAir) --z;
        put(world, blocks, {x, y, z}, idOf(blocks, kLamps[k]));
    }
}

// Walls and a roof of glass, corners of wood, flowers and two lamps inside.
void buildGlassHouse(World& world, const BlockRegistry& blocks) {
    buildGround(world, blocks, "grass");
    const BlockId glass = idOf(blocks, "cyan_glass"), log = idOf(blocks, "oak_log");
    fill(world, blocks, {-5, -4, kGround}, {6, 5, kGround + 5}, glass);
    fill(world, blocks, {-4, -3, kGround}, {5, 4, kGround + 4}, world::kAir);
    for (const int x : {-5, 5}) {
        for (const int y : {-4, 4}) fill(world, blocks, {x, y, kGround}, {x + 1, y + 1, kGround + 5}, log);
    }
    fill(world, blocks, {0, -4, kGround}, {1, -3, kGround + 2}, world::kAir);  // the door
    put(world, blocks, {-3, 1, kGround}, idOf(blocks, "lamp_white"));
    put(world, blocks, {3, 2, kGround}, idOf(blocks, "lamp_red"));
    constexpr std::array kPlants = {"poppy", "blue_orchid", "oxeye_daisy", "grass_tuft"};
    for (int k = 0; k < 60; ++k) {
        const unsigned hash = shared::hash3(static_cast<unsigned>(k), 5u, 0u, 1u);
        const BlockPos at{static_cast<int>(hash % 25) - 12, static_cast<int>(hash / 25 % 21) - 12, kGround};
        if (world.block(at) == world::kAir) put(world, blocks, at, idOf(blocks, kPlants[hash / 800 % 4]));
    }
}

// Two rooms without a roof whose walls meet at an edge: one has red light, the other none.
void buildCorner(World& world, const BlockRegistry& blocks) {
    buildGround(world, blocks, "grass");
    const BlockId stone = idOf(blocks, "stone");
    fill(world, blocks, {-6, -6, kGround}, {7, 7, kGround + 3}, stone);
    fill(world, blocks, {1, 1, kGround}, {6, 6, kGround + 3}, world::kAir);
    fill(world, blocks, {-5, -5, kGround}, {1, 1, kGround + 3}, world::kAir);
    fill(world, blocks, {0, 1, kGround}, {1, 6, kGround + 3}, stone);
    fill(world, blocks, {1, 0, kGround}, {6, 1, kGround + 3}, stone);
    put(world, blocks, {0, 0, kGround}, world::kAir);
    put(world, blocks, {3, 3, kGround}, idOf(blocks, "lamp_red"));
}

void buildOneLamp(World& world, const BlockRegistry& blocks) {
    buildLamps(world, blocks, {1, 1});
}

}  // namespace

void buildLamps(World& world, const BlockRegistry& blocks, LampCount count) {
    buildGround(world, blocks, "stone");
    constexpr std::array kLamps = {"lamp_white", "lamp_red", "lamp_green", "lamp_blue"};
    constexpr auto kSide = static_cast<unsigned>(kEnd - kFirst);
    put(world, blocks, {0, 0, kGround}, idOf(blocks, kLamps[0]));
    int placed = 1;
    for (unsigned k = 0; placed < count.places; ++k) {
        const unsigned hash = shared::hash3(k, 7u, 0u, 1u);
        const BlockPos at{kFirst + static_cast<int>(hash % kSide),
                          kFirst + static_cast<int>(hash / kSide % kSide), kGround};
        if (world.block(at) != world::kAir) continue;
        const bool isLamp = placed < count.lamps;
        const char* name = isLamp ? kLamps[static_cast<std::size_t>(placed) % kLamps.size()] : "stone";
        put(world, blocks, at, idOf(blocks, name));
        ++placed;
    }
}

const std::vector<LightScene>& lightScenes() {
    static const std::vector<LightScene> scenes = {
        {"cave", buildCave, {{0.0, -13.0, 86.0}, 90, -22}, 0.0f},
        {"glass_house", buildGlassHouse, {{6.5, -10.5, 86.5}, 122, -27}, 0.835f},
        {"corner", buildCorner, {{-0.6, -0.9, 87.0}, 48, -70}, 0.0f},
        {"diamond", buildOneLamp, {{0.5, 0.5, 104.0}, 90, -90}, 0.0f},
    };
    return scenes;
}

}  // namespace terrane::examples
