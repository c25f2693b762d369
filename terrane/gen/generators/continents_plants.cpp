#include "terrane/gen/generators/continents.h"
#include "terrane/gen/generators/landforms.h"

// What grows in each biome of continents, and where.

namespace terrane::gen::continents {

namespace {

using trees::Kind;
using vegetation::Grove;
using vegetation::Plant;

constexpr Grove kTrees[] = {
    {Biome::Meadow, Kind::Oak, 0.018f},         {Biome::Meadow, Kind::Birch, 0.008f},
    {Biome::OakForest, Kind::Oak, 0.62f},       {Biome::OakForest, Kind::Birch, 0.12f},
    {Biome::BirchForest, Kind::Birch, 0.66f},   {Biome::BirchForest, Kind::Oak, 0.06f},
    {Biome::BirchForest, Kind::Spruce, 0.05f},  {Biome::OldForest, Kind::OldOak, 0.17f},
    {Biome::OldForest, Kind::Oak, 0.46f},       {Biome::OldForest, Kind::GiantMushroom, 0.012f},
    {Biome::Taiga, Kind::Spruce, 0.46f},        {Biome::Taiga, Kind::Pine, 0.16f},
    {Biome::Taiga, Kind::Larch, 0.13f},         {Biome::Tundra, Kind::Spruce, 0.014f},
    {Biome::Tundra, Kind::DeadTree, 0.005f},    {Biome::Snow, Kind::Spruce, 0.05f},
    {Biome::Savanna, Kind::Acacia, 0.07f},      {Biome::Savanna, Kind::Baobab, 0.007f},
    {Biome::Desert, Kind::DeadTree, 0.0012f},   {Biome::CanyonLand, Kind::Pine, 0.03f},
    {Biome::CanyonLand, Kind::DeadTree, 0.01f}, {Biome::Swamp, Kind::Willow, 0.26f},
    {Biome::Swamp, Kind::Cypress, 0.24f},       {Biome::Alpine, Kind::Pine, 0.10f},
    {Biome::Alpine, Kind::Larch, 0.06f},        {Biome::RainForest, Kind::Palm, 0.26f},
    {Biome::RainForest, Kind::OldOak, 0.13f},   {Biome::RainForest, Kind::Oak, 0.3f},
    {Biome::Beach, Kind::Palm, 0.08f},
};

constexpr Grove kSmall[] = {
    {Biome::Meadow, Kind::Bush, 0.05f},         {Biome::Meadow, Kind::Boulder, 0.006f},
    {Biome::OakForest, Kind::Bush, 0.12f},      {Biome::OakForest, Kind::FallenLog, 0.02f},
    {Biome::BirchForest, Kind::Bush, 0.06f},    {Biome::BirchForest, Kind::FallenLog, 0.015f},
    {Biome::OldForest, Kind::FallenLog, 0.04f}, {Biome::OldForest, Kind::Bush, 0.12f},
    {Biome::OldForest, Kind::Boulder, 0.012f},  {Biome::Taiga, Kind::Boulder, 0.02f},
    {Biome::Taiga, Kind::FallenLog, 0.015f},    {Biome::Tundra, Kind::Boulder, 0.03f},
    {Biome::Snow, Kind::Boulder, 0.01f},        {Biome::Savanna, Kind::Bush, 0.05f},
    {Biome::Savanna, Kind::Boulder, 0.006f},    {Biome::CanyonLand, Kind::Bush, 0.04f},
    {Biome::CanyonLand, Kind::Boulder, 0.02f},  {Biome::Swamp, Kind::Bush, 0.06f},
    {Biome::Swamp, Kind::FallenLog, 0.02f},     {Biome::Alpine, Kind::Boulder, 0.035f},
    {Biome::RainForest, Kind::Bush, 0.2f},      {Biome::Desert, Kind::Boulder, 0.004f},
};

constexpr Plant kPlants[] = {
    {Biome::Meadow, "tall_grass", 0.20f},
    {Biome::Meadow, "grass_tuft", 0.24f},
    {Biome::Meadow, "oxeye_daisy", 0.03f},
    {Biome::Meadow, "poppy", 0.02f},
    {Biome::Meadow, "bluebell", 0.02f},
    {Biome::OakForest, "grass_tuft", 0.14f},
    {Biome::OakForest, "fern", 0.04f},
    {Biome::OakForest, "brown_mushroom", 0.003f},
    {Biome::BirchForest, "grass_tuft", 0.18f},
    {Biome::BirchForest, "bluebell", 0.05f},
    {Biome::OldForest, "fern", 0.20f},
    {Biome::OldForest, "red_mushroom", 0.008f},
    {Biome::Taiga, "fern", 0.10f},
    {Biome::Taiga, "grass_tuft", 0.05f},
    {Biome::Tundra, "heather", 0.16f},
    {Biome::Tundra, "grass_tuft", 0.06f},
    {Biome::Savanna, "savanna_grass", 0.50f},
    {Biome::CanyonLand, "dead_bush", 0.012f},
    {Biome::CanyonLand, "savanna_grass", 0.03f},
    {Biome::Desert, "dead_bush", 0.004f},
    {Biome::Swamp, "tall_grass", 0.22f},
    {Biome::Swamp, "fern", 0.08f},
    {Biome::Alpine, "grass_tuft", 0.14f},
    {Biome::Alpine, "heather", 0.08f},
    {Biome::Alpine, "bluebell", 0.02f},
    {Biome::RainForest, "fern", 0.30f},
    {Biome::RainForest, "tall_grass", 0.14f},
    {Biome::RainForest, "blue_orchid", 0.012f},
    {Biome::Reef, "seagrass", 0.05f},
    {Biome::Reef, "coral_red", 0.04f},
    {Biome::Reef, "coral_yellow", 0.03f},
    {Biome::Ocean, "seagrass", 0.015f},
};

constexpr vegetation::BiomeNumber kInWater[] = {Biome::Reef, Biome::Ocean};
constexpr vegetation::Tables kTables = {kTrees,   kSmall, kPlants,      static_cast<int>(Biome::Count),
                                        kInWater, 20,     Biome::Desert};

// Trees stand on earth that no cave is near. On beaches only where it is warm, in mountains up to the tree
// line.
Bool canGrow(Pass& p, const Fields& f) {
    const Block top = p.read(f.top);
    const auto is = [&](const char* name) { return top == p.block(name); };
    const Bool isEarth =
        is("grass") || is("moss") || is("mud") || is("snow") || is("sand") || is("red_sand") || is("gravel");
    const Float cold = p.read(f.cold);
    const Bool isWarmBeach = p.read(f.biome) != number(Biome::Beach) || cold > 0.18f;
    const Bool isBelowTreeLine = p.read(f.biome) != number(Biome::Alpine) || cold > -0.3f;
    Bool result = isEarth && isWarmBeach && isBelowTreeLine && p.read(f.surface) >= p.read(f.water);
    if (p.step() == 1) result = result && p.read(f.caveTop) < p.read(f.surface) - 3;
    return result;
}

}  // namespace

const vegetation::Tables& vegetationTables() {
    return kTables;
}

void plantsPass(Pass& p, const Fields& f) {
    const Float share = select(canGrow(p, f), vegetation::woodland(p, p.read(f.forest)), Float(0.0f));
    vegetation::setShapes(p, f.plants, kTables, {p.read(f.biome), share, share, p.read(f.surface)});
    if (p.step() > 1) return;
    vegetation::setPlants(p, f.plants, kTables,
                          {p.read(f.biome), p.read(f.top), p.read(f.water) - p.read(f.surface),
                           p.read(f.caveTop) < p.read(f.surface) - 3, p.read(f.wet), p.read(f.cold)});
}

void landPass(Pass& p, const Fields& f) {
    p.setBlock(vegetation::overGround(p, f.plants, p.read(f.surface), ground(p, f)));
}

void caveLifePass(Pass& p, const Fields& f) {
    landforms::growCaveLife(p, p.read(f.caveTop), {40, 0.012f, 0.04f, 0.05f});
}

}  // namespace terrane::gen::continents
