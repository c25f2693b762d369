// Builds a lit hamlet by the shore into a world: a program that edits blocks as a player does. Draw it with
//
//     village VILLAGE.sqlite X,Y [hall]
//     terrane render --world VILLAGE.sqlite --at X,Y,Z --look YAW,PITCH --time 0.82 -o village.png
//
// With `hall` it builds a hall of glass with its middle there, and a cave with lamps below, for images of the
// path tracer (tools/path_images.py).
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "terrane/content/built_in.h"
#include "terrane/game/session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/saves/open_world.h"
#include "terrane/world/blocks/block_model.h"

namespace {

using namespace terrane;
using world::BlockPos;

constexpr const char* kGenerator = "continents";
constexpr std::uint64_t kSeed = 1;
constexpr int kRadius = 4;  // chunks to load
constexpr int kStep = 13;   // blocks from house to house
constexpr int kReach = 44;  // blocks from the middle to the last house
constexpr int kJettyLength = 16;

struct Site {
    game::Session& session;
    BlockPos middle;

    world::BlockId id(const char* name) const { return session.blocks().find(name)->id; }
    const std::string& nameAt(BlockPos pos) const {
        return session.blocks().type(session.world().block(pos)).name;
    }
    // `state`: see world/block_model.h.
    void put(BlockPos pos, const char* name, std::uint16_t state = 0) {
        session.edit({.pos = pos, .change = world::SetBlock{id(name), state}, .expected = {}});
    }
    // Both corners included.
    void fill(BlockPos a, BlockPos b, const char* name, std::uint16_t state = 0) {
        for (int z = a.z; z <= b.z; ++z)
            for (int y = a.y; y <= b.y; ++y)
                for (int x = a.x; x <= b.x; ++x) put({x, y, z}, name, state);
    }
    // The highest block of the ground or the sea.
    int groundAt(int x, int y) const {
        const world::Heights heights = session.world().heights();
        int z = heights.top - 1;
        const auto isGround = [&](const std::string& name) {
            return name == "water" || (session.blocks().find(name)->opaqueCube && !name.ends_with("_log"));
        };
        while (z > heights.bottom && !isGround(nameAt({x, y, z}))) --z;
        return z;
    }
    bool isWater(int x, int y) const { return nameAt({x, y, groundAt(x, y)}) == "water"; }
};

void loadAround(game::Session& session, world::ChunkPos middle) {
    stream::ChunkPipeline& pipeline = session.pipeline();
    pipeline.setView(middle, kRadius);
    for (pipeline.update(); !pipeline.progress().isUpToDate(); pipeline.update())
        pipeline.waitForWorkers(std::chrono::milliseconds(100));
}

// Whether 7 × 7 blocks from the corner on are dry and nearly level.
bool isGoodGround(const Site& site, int x, int y, int& ground) {
    const world::Heights heights = site.session.world().heights();
    int lowest = heights.top, highest = heights.bottom;
    for (int k = 0; k < 49; ++k) {
        const int px = x + k % 7, py = y + k / 7;
        if (site.isWater(px, py)) return false;
        lowest = std::min(lowest, site.groundAt(px, py));
        highest = std::max(highest, site.groundAt(px, py));
    }
    ground = highest;
    return highest - lowest <= 3;
}

// Block states of blocks with a facing.
constexpr std::uint16_t kTowardPosY = 0, kTowardNegY = 2, kTowardPosX = 3;

// A gable roof along x over a house of seven blocks: steps that rise to the ridge from both sides.
void buildRoof(Site& site, int x, int y, int eaves) {
    for (int rise = 0; rise < 4; ++rise) {
        const int z = eaves + rise;
        site.fill({x, y + rise, z + 1}, {x + 6, y + 6 - rise, z + 1}, "oak_planks");
        site.fill({x - 1, y + rise - 1, z}, {x + 7, y + rise - 1, z}, "roof_tiles_stairs", kTowardPosY);
        site.fill({x - 1, y + 7 - rise, z}, {x + 7, y + 7 - rise, z}, "roof_tiles_stairs", kTowardNegY);
        if (rise > 0) site.fill({x + 1, y + rise, z}, {x + 5, y + 6 - rise, z}, "air");
    }
    site.fill({x - 1, y + 3, eaves + 4}, {x + 7, y + 3, eaves + 4}, "roof_tiles_slab");
}

// A fence around the garden, with a gate before the door.
void buildGarden(Site& site, int x, int y, int ground) {
    const int floor = ground + 1;
    site.fill({x - 1, y - 4, ground - 2}, {x + 7, y - 1, ground}, "grass");
    site.fill({x - 1, y - 4, floor}, {x + 7, y - 2, floor + 3}, "air");
    site.fill({x - 1, y - 4, floor}, {x + 7, y - 4, floor}, "oak_fence");
    for (const int side : {x - 1, x + 7}) site.fill({side, y - 3, floor}, {side, y - 1, floor}, "oak_fence");
    site.put({x + 3, y - 4, floor}, "oak_gate", kTowardPosY);
    site.fill({x + 3, y - 3, ground}, {x + 3, y - 1, ground}, "gravel");
    site.put({x + 1, y - 2, floor}, "poppy");
    site.put({x + 5, y - 2, floor}, "oxeye_daisy");
    site.put({x - 1, y - 4, floor + 1}, "torch");
    site.put({x + 7, y - 4, floor + 1}, "torch");
}

// Seven blocks square, with a door to the south, windows, and a lantern under the roof.
void buildHouse(Site& site, int x, int y, int ground) {
    const int floor = ground + 1;
    site.fill({x, y, ground - 3}, {x + 6, y + 6, ground}, "cobble");
    site.fill({x + 1, y + 1, ground}, {x + 5, y + 5, ground}, "spruce_planks");
    site.fill({x, y, floor}, {x + 6, y + 6, floor + 9}, "air");
    site.fill({x, y, floor}, {x + 6, y + 6, floor + 2}, "plaster");
    site.fill({x, y, floor}, {x + 6, y + 6, floor}, "cobble");
    site.fill({x + 1, y + 1, floor}, {x + 5, y + 5, floor + 2}, "air");
    for (const int dx : {0, 6})
        for (const int dy : {0, 6})
            site.fill({x + dx, y + dy, floor}, {x + dx, y + dy, floor + 2}, "oak_log");
    buildRoof(site, x, y, floor + 2);
    site.fill({x + 3, y, floor}, {x + 3, y, floor + 1}, "air");
    site.put({x + 3, y, floor}, "oak_door", kTowardPosY);
    for (const int dx : {0, 6})
        site.fill({x + dx, y + 2, floor + 1}, {x + dx, y + 4, floor + 1}, "glass_pane");
    site.put({x + 3, y + 3, floor + 4}, "lantern", world::kStateUpsideDown);
    site.fill({x + 5, y + 2, floor}, {x + 5, y + 4, floor}, "oak_stairs", kTowardPosX);
    site.fill({x + 1, y + 5, floor}, {x + 1, y + 5, floor + 1}, "bookshelf");
    site.fill({x + 2, y + 2, floor}, {x + 4, y + 4, floor}, "red_carpet");
    site.put({x + 2, y - 1, floor + 1}, "torch", kTowardPosY | world::kStateOther);
    buildGarden(site, x, y, ground);
}

int buildHouses(Site& site) {
    int count = 0, ground = 0;
    for (int dy = -kReach; dy <= kReach; dy += kStep) {
        for (int dx = -kReach; dx <= kReach; dx += kStep) {
            const int x = site.middle.x + dx, y = site.middle.y + dy;
            if (!isGoodGround(site, x, y, ground)) continue;
            buildHouse(site, x, y, ground);
            ++count;
        }
    }
    return count;
}

// A jetty from the shore into the sea, along x.
void buildJetty(Site& site) {
    int x = site.middle.x;
    const int y = site.middle.y, toSea = site.isWater(x - kReach, y) ? -1 : 1;
    while (std::abs(x - site.middle.x) < kReach && !site.isWater(x, y)) x += toSea;
    const int deck = site.groundAt(x, y) + 1;
    for (int k = -3; k < kJettyLength; ++k) {
        const int at = x + toSea * k;
        site.fill({at, y, deck}, {at, y + 2, deck}, "oak_planks");
        if (k % 5 != 0) continue;
        site.fill({at, y, deck - 6}, {at, y, deck + 1}, "oak_log");
        site.put({at, y, deck + 2}, "lantern");
    }
}

// A hall of colored glass between pillars, with a basin of water. Returns the layer of its floor.
int buildHall(Site& site) {
    constexpr int kHalfLength = 14, kHalfWidth = 6, kHeight = 9;
    constexpr const char* kColors[] = {"red_glass", "orange_glass", "yellow_glass", "green_glass",
                                       "blue_glass"};
    const auto [mx, my, unused] = site.middle;
    const int floor = site.groundAt(mx, my);
    const int x0 = mx - kHalfLength, x1 = mx + kHalfLength, y0 = my - kHalfWidth, y1 = my + kHalfWidth;
    site.fill({x0 - 3, y0 - 3, floor + 1}, {x1 + 3, y1 + 3, floor + 20}, "air");
    site.fill({x0 - 3, y0 - 3, floor - 3}, {x1 + 3, y1 + 3, floor}, "stone_bricks");
    for (int x = x0; x <= x1; ++x) {
        for (int y = y0; y <= y1; ++y)
            if (((x + y) & 1) == 0) site.put({x, y, floor}, "birch_planks");
        const bool isPillar = (x - x0) % 4 == 0;
        const char* wall = isPillar ? "stone_bricks" : kColors[static_cast<unsigned>(x - x0) / 4 % 5];
        for (const int y : {y0, y1}) {
            site.fill({x, y, floor + 1}, {x, y, floor + kHeight}, wall);
            if (isPillar) site.put({x, y + (y == y0 ? 1 : -1), floor + 5}, "lantern");
        }
        for (int rise = 0; rise <= kHalfWidth; ++rise) {
            const char* roof = isPillar ? "spruce_planks" : "white_glass";
            for (const int y : {y0 + rise, y1 - rise}) site.put({x, y, floor + kHeight + rise / 2}, roof);
        }
    }
    site.fill({mx - 6, my - 2, floor - 2}, {mx + 6, my + 2, floor}, "air");
    site.fill({mx - 6, my - 2, floor - 2}, {mx + 6, my + 2, floor - 1}, "water");
    return floor;
}

// A cave with uneven walls below the hall, with lamps on its floor.
void buildLampCave(Site& site, int top) {
    constexpr const char* kLamps[] = {"lamp_white", "lantern", "lamp_red", "lamp_blue", "torch"};
    const auto [mx, my, unused] = site.middle;
    const int mz = top - 16;
    site.fill({mx - 24, my - 18, mz - 10}, {mx + 24, my + 18, mz + 10}, "stone");
    const auto isOpen = [&](int x, int y, int z) {
        const double u = (x - mx) / 20.0, v = (y - my) / 14.0, w = (z - mz) / 7.0;
        const double bumps =
            0.2 * std::sin(x * 0.7 + z * 0.3) * std::sin(y * 0.6) + 0.15 * std::sin(z * 0.9 + x);
        return u * u + v * v + w * w + bumps < 1;
    };
    for (int z = mz - 9; z <= mz + 9; ++z)
        for (int y = my - 17; y <= my + 17; ++y)
            for (int x = mx - 23; x <= mx + 23; ++x)
                if (isOpen(x, y, z)) site.put({x, y, z}, "air");
    for (int k = 0; k < 5; ++k) {
        const int x = mx - 12 + 6 * k, y = my + (k % 2 == 0 ? -4 : 5);
        int z = mz;
        while (site.nameAt({x, y, z - 1}) == "air") --z;
        site.put({x, y, z}, kLamps[k]);
    }
}

base::Result<int> build(const std::string& path, BlockPos middle, bool isHall) {
    auto loaded = content::loadBlocks();
    if (!loaded) return tl::unexpected(loaded.error());
    auto blocks = std::make_unique<const world::BlockRegistry>(std::move(*loaded));
    store::WorldRequest request;
    request.access = store::WorldAccess::ReadWrite;
    request.create =
        store::WorldIdentity{kSeed, kGenerator, gen::versionOf(gen::builtInGenerators(), kGenerator)};
    request.versionOf = [](std::string_view name) { return gen::versionOf(gen::builtInGenerators(), name); };
    auto opened = store::openWorld(store::worldLocation(path), *blocks, request);
    if (!opened) return tl::unexpected(opened.error());
    const store::WorldIdentity& world = (*opened)->identity();
    auto generators = gen::makeLevelGenerators(world.generator, *blocks, world.seed, gen::builtInGenerators(),
                                               world.heights);
    if (!generators) return tl::unexpected(generators.error());
    game::Session session({std::move(blocks), std::move(*generators), std::move(*opened), 2});
    loadAround(session, {middle.x >> 4, middle.y >> 4});
    Site site{session, middle};
    int houses = 1;
    if (isHall) {
        buildLampCave(site, buildHall(site));
    } else {
        buildJetty(site);
        houses = buildHouses(site);
    }
    loadAround(session, {middle.x >> 4, middle.y >> 4});
    if (auto saved = session.save(); !saved) return tl::unexpected(saved.error());
    return houses;
}

}  // namespace

int main(int argc, char** argv) {
    BlockPos middle{};
    const bool isHall = argc == 4 && std::string(argv[3]) == "hall";
    if ((argc != 3 && !isHall) || std::sscanf(argv[2], "%d,%d", &middle.x, &middle.y) != 2)
        return std::fprintf(stderr, "usage: village VILLAGE.sqlite X,Y [hall]\n"), 1;
    const auto houses = build(argv[1], middle, isHall);
    if (!houses) return std::fprintf(stderr, "%s\n", houses.error().message.c_str()), 1;
    std::printf("%d houses\n", *houses);
}
