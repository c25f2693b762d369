#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/wilderness.h"

// What grows in each biome of wilderness, and where.

namespace terrane::gen::wilderness {

namespace {

using trees::Kind;
using vegetation::Grove;
using vegetation::Plant;

constexpr Grove kTrees[] = {
    {Biome::Beach, Kind::Palm, 0.06f},
    {Biome::Mangrove, Kind::Mangrove, 0.45f},
    {Biome::Mangrove, Kind::Palm, 0.06f},
    {Biome::Meadow, Kind::Oak, 0.014f},
    {Biome::Meadow, Kind::Poplar, 0.008f},
    {Biome::Meadow, Kind::Birch, 0.006f},
    {Biome::Steppe, Kind::Poplar, 0.002f},
    {Biome::Steppe, Kind::Juniper, 0.006f},
    {Biome::OakForest, Kind::Oak, 0.5f},
    {Biome::OakForest, Kind::Beech, 0.1f},
    {Biome::OakForest, Kind::Birch, 0.1f},
    {Biome::OakForest, Kind::YoungOak, 0.12f},
    {Biome::OakForest, Kind::Snag, 0.008f},
    {Biome::BeechForest, Kind::Beech, 0.55f},
    {Biome::BeechForest, Kind::OldOak, 0.05f},
    {Biome::BeechForest, Kind::YoungOak, 0.1f},
    {Biome::BeechForest, Kind::Snag, 0.01f},
    {Biome::BirchForest, Kind::Birch, 0.5f},
    {Biome::BirchForest, Kind::Aspen, 0.2f},
    {Biome::BirchForest, Kind::YoungBirch, 0.14f},
    {Biome::BirchForest, Kind::Spruce, 0.03f},
    {Biome::MapleForest, Kind::Maple, 0.5f},
    {Biome::MapleForest, Kind::Aspen, 0.15f},
    {Biome::MapleForest, Kind::Beech, 0.08f},
    {Biome::MapleForest, Kind::YoungOak, 0.05f},
    {Biome::OldForest, Kind::OldOak, 0.2f},
    {Biome::OldForest, Kind::Beech, 0.3f},
    {Biome::OldForest, Kind::Oak, 0.2f},
    {Biome::OldForest, Kind::GiantMushroom, 0.008f},
    {Biome::OldForest, Kind::Snag, 0.02f},
    {Biome::GiantForest, Kind::Sequoia, 0.3f},
    {Biome::GiantForest, Kind::Fir, 0.12f},
    {Biome::GiantForest, Kind::YoungFir, 0.12f},
    {Biome::GiantForest, Kind::TreeFern, 0.05f},
    {Biome::GiantForest, Kind::Snag, 0.012f},
    {Biome::Swamp, Kind::Willow, 0.26f},
    {Biome::Swamp, Kind::Cypress, 0.22f},
    {Biome::Swamp, Kind::Snag, 0.03f},
    {Biome::Bog, Kind::Spruce, 0.04f},
    {Biome::Bog, Kind::YoungSpruce, 0.05f},
    {Biome::Bog, Kind::Snag, 0.03f},
    {Biome::Taiga, Kind::Spruce, 0.38f},
    {Biome::Taiga, Kind::Pine, 0.14f},
    {Biome::Taiga, Kind::YoungSpruce, 0.16f},
    {Biome::Taiga, Kind::Snag, 0.012f},
    {Biome::FirForest, Kind::Fir, 0.5f},
    {Biome::FirForest, Kind::YoungFir, 0.2f},
    {Biome::FirForest, Kind::Larch, 0.06f},
    {Biome::FirForest, Kind::Snag, 0.012f},
    {Biome::LarchForest, Kind::Larch, 0.48f},
    {Biome::LarchForest, Kind::YoungSpruce, 0.05f},
    {Biome::LarchForest, Kind::Pine, 0.05f},
    {Biome::Tundra, Kind::YoungSpruce, 0.012f},
    {Biome::Tundra, Kind::Krummholz, 0.012f},
    {Biome::Snow, Kind::Spruce, 0.02f},
    {Biome::Snow, Kind::YoungSpruce, 0.02f},
    {Biome::AlpineMeadow, Kind::Krummholz, 0.24f},
    {Biome::AlpineMeadow, Kind::Larch, 0.16f},
    {Biome::AlpineMeadow, Kind::Pine, 0.12f},
    {Biome::Rocks, Kind::Krummholz, 0.01f},
    {Biome::Savanna, Kind::Acacia, 0.07f},
    {Biome::Savanna, Kind::Baobab, 0.006f},
    {Biome::Shrubland, Kind::Olive, 0.07f},
    {Biome::Shrubland, Kind::Cypress, 0.04f},
    {Biome::Shrubland, Kind::StonePine, 0.05f},
    {Biome::Shrubland, Kind::Cedar, 0.02f},
    {Biome::Shrubland, Kind::Juniper, 0.06f},
    {Biome::Desert, Kind::DeadTree, 0.0012f},
    {Biome::Desert, Kind::JoshuaTree, 0.004f},
    {Biome::Badlands, Kind::Juniper, 0.03f},
    {Biome::Badlands, Kind::JoshuaTree, 0.012f},
    {Biome::Badlands, Kind::DeadTree, 0.01f},
    {Biome::RainForest, Kind::Kapok, 0.07f},
    {Biome::RainForest, Kind::Fig, 0.12f},
    {Biome::RainForest, Kind::Palm, 0.14f},
    {Biome::RainForest, Kind::OldOak, 0.12f},
    {Biome::RainForest, Kind::TreeFern, 0.12f},
    {Biome::CloudForest, Kind::TreeFern, 0.2f},
    {Biome::CloudForest, Kind::Fig, 0.1f},
    {Biome::CloudForest, Kind::OldOak, 0.18f},
    {Biome::CloudForest, Kind::Oak, 0.2f},
    {Biome::BambooForest, Kind::Bamboo, 0.75f},
    {Biome::BambooForest, Kind::Fig, 0.02f},
    {Biome::CherryGrove, Kind::Cherry, 0.22f},
    {Biome::CherryGrove, Kind::Birch, 0.04f},
    {Biome::LavaField, Kind::DeadTree, 0.002f},
    {Biome::StonyShore, Kind::StonePine, 0.01f},
};

constexpr Grove kSmall[] = {
    {Biome::Meadow, Kind::Bush, 0.04f},
    {Biome::Meadow, Kind::Boulder, 0.006f},
    {Biome::Meadow, Kind::Hazel, 0.02f},
    {Biome::Steppe, Kind::DryShrub, 0.03f},
    {Biome::Steppe, Kind::Boulder, 0.006f},
    {Biome::OakForest, Kind::Hazel, 0.1f},
    {Biome::OakForest, Kind::Bush, 0.06f},
    {Biome::OakForest, Kind::FallenLog, 0.02f},
    {Biome::OakForest, Kind::Stump, 0.015f},
    {Biome::OakForest, Kind::UprootedTree, 0.008f},
    {Biome::BeechForest, Kind::FallenLog, 0.02f},
    {Biome::BeechForest, Kind::Stump, 0.02f},
    {Biome::BeechForest, Kind::Hazel, 0.05f},
    {Biome::BeechForest, Kind::UprootedTree, 0.01f},
    {Biome::BirchForest, Kind::Bush, 0.06f},
    {Biome::BirchForest, Kind::FallenLog, 0.015f},
    {Biome::MapleForest, Kind::Bush, 0.08f},
    {Biome::MapleForest, Kind::Stump, 0.01f},
    {Biome::OldForest, Kind::FallenLog, 0.04f},
    {Biome::OldForest, Kind::Thicket, 0.12f},
    {Biome::OldForest, Kind::UprootedTree, 0.02f},
    {Biome::OldForest, Kind::Boulder, 0.012f},
    {Biome::GiantForest, Kind::FallenLog, 0.06f},
    {Biome::GiantForest, Kind::Thicket, 0.1f},
    {Biome::GiantForest, Kind::UprootedTree, 0.02f},
    {Biome::Swamp, Kind::Bush, 0.06f},
    {Biome::Swamp, Kind::FallenLog, 0.02f},
    {Biome::Swamp, Kind::Thicket, 0.06f},
    {Biome::Taiga, Kind::Boulder, 0.02f},
    {Biome::Taiga, Kind::FallenLog, 0.015f},
    {Biome::Taiga, Kind::Stump, 0.01f},
    {Biome::FirForest, Kind::Boulder, 0.03f},
    {Biome::FirForest, Kind::FallenLog, 0.02f},
    {Biome::FirForest, Kind::UprootedTree, 0.01f},
    {Biome::LarchForest, Kind::Boulder, 0.02f},
    {Biome::LarchForest, Kind::Bush, 0.04f},
    {Biome::Tundra, Kind::Boulder, 0.03f},
    {Biome::Snow, Kind::Boulder, 0.02f},
    {Biome::AlpineMeadow, Kind::Boulder, 0.06f},
    {Biome::AlpineMeadow, Kind::Bush, 0.06f},
    {Biome::Rocks, Kind::Boulder, 0.04f},
    {Biome::StonyShore, Kind::Boulder, 0.1f},
    {Biome::Savanna, Kind::Bush, 0.05f},
    {Biome::Savanna, Kind::DryShrub, 0.05f},
    {Biome::Shrubland, Kind::DryShrub, 0.2f},
    {Biome::Shrubland, Kind::Bush, 0.08f},
    {Biome::Shrubland, Kind::DwarfPalm, 0.03f},
    {Biome::Desert, Kind::DryShrub, 0.008f},
    {Biome::Desert, Kind::Boulder, 0.004f},
    {Biome::Badlands, Kind::DryShrub, 0.05f},
    {Biome::Badlands, Kind::Boulder, 0.02f},
    {Biome::RainForest, Kind::Thicket, 0.2f},
    {Biome::RainForest, Kind::DwarfPalm, 0.1f},
    {Biome::RainForest, Kind::FallenLog, 0.02f},
    {Biome::CloudForest, Kind::Thicket, 0.25f},
    {Biome::CloudForest, Kind::FallenLog, 0.03f},
    {Biome::BambooForest, Kind::Bush, 0.06f},
    {Biome::CherryGrove, Kind::Bush, 0.03f},
    {Biome::LavaField, Kind::Boulder, 0.05f},
    {Biome::Mangrove, Kind::Thicket, 0.05f},
};

constexpr Plant kPlants[] = {
    {Biome::Meadow, "tall_grass", 0.20f},
    {Biome::Meadow, "grass_tuft", 0.24f},
    {Biome::Meadow, "oxeye_daisy", 0.03f},
    {Biome::Meadow, "poppy", 0.02f},
    {Biome::Meadow, "bluebell", 0.02f},
    {Biome::Steppe, "savanna_grass", 0.35f},
    {Biome::Steppe, "grass_tuft", 0.1f},
    {Biome::OakForest, "grass_tuft", 0.14f},
    {Biome::OakForest, "fern", 0.04f},
    {Biome::OakForest, "brown_mushroom", 0.003f},
    {Biome::BeechForest, "fern", 0.06f},
    {Biome::BeechForest, "bluebell", 0.08f},
    {Biome::BirchForest, "grass_tuft", 0.18f},
    {Biome::BirchForest, "bluebell", 0.05f},
    {Biome::MapleForest, "grass_tuft", 0.12f},
    {Biome::OldForest, "fern", 0.20f},
    {Biome::OldForest, "red_mushroom", 0.008f},
    {Biome::GiantForest, "fern", 0.3f},
    {Biome::Taiga, "fern", 0.10f},
    {Biome::Taiga, "grass_tuft", 0.05f},
    {Biome::FirForest, "fern", 0.08f},
    {Biome::LarchForest, "grass_tuft", 0.12f},
    {Biome::Tundra, "heather", 0.16f},
    {Biome::Tundra, "grass_tuft", 0.06f},
    {Biome::Bog, "heather", 0.2f},
    {Biome::Bog, "tall_grass", 0.1f},
    {Biome::AlpineMeadow, "grass_tuft", 0.24f},
    {Biome::AlpineMeadow, "oxeye_daisy", 0.06f},
    {Biome::AlpineMeadow, "bluebell", 0.08f},
    {Biome::AlpineMeadow, "poppy", 0.02f},
    {Biome::AlpineMeadow, "heather", 0.08f},
    {Biome::Savanna, "savanna_grass", 0.50f},
    {Biome::Shrubland, "savanna_grass", 0.2f},
    {Biome::Shrubland, "heather", 0.05f},
    {Biome::Badlands, "dead_bush", 0.012f},
    {Biome::Desert, "dead_bush", 0.004f},
    {Biome::Swamp, "tall_grass", 0.22f},
    {Biome::Swamp, "fern", 0.08f},
    {Biome::RainForest, "fern", 0.30f},
    {Biome::RainForest, "tall_grass", 0.14f},
    {Biome::RainForest, "blue_orchid", 0.012f},
    {Biome::CloudForest, "fern", 0.34f},
    {Biome::BambooForest, "fern", 0.1f},
    {Biome::CherryGrove, "poppy", 0.05f},
    {Biome::CherryGrove, "grass_tuft", 0.2f},
    {Biome::Reef, "seagrass", 0.05f},
    {Biome::Reef, "coral_red", 0.04f},
    {Biome::Reef, "coral_yellow", 0.03f},
    {Biome::Ocean, "seagrass", 0.015f},
    {Biome::KelpForest, "seagrass", 0.2f},
};

constexpr vegetation::BiomeNumber kInWater[] = {Biome::Reef, Biome::Ocean, Biome::KelpForest};
constexpr Kind kPlaced[] = {Kind::GiantTree};
constexpr vegetation::Tables kTables = {kTrees,   kSmall, kPlants,       static_cast<int>(Biome::Count),
                                        kInWater, 30,     Biome::Desert, kPlaced};

// 0…1: worlds begin in a glade around block 0, 0, so that one sees far.
Float beyondGlade(Pass& p) {
    return smoothstep(0.16f, 0.8f, landforms::fromOrigin(p, 256));
}

// Trees and stones stand on earth that no cave is near. On beaches only where it is warm.
Bool canGrow(Pass& p, const Fields& f) {
    const Block top = p.read(f.top);
    const auto is = [&](const char* name) { return top == p.block(name); };
    const Bool isEarth = is("grass") || is("moss") || is("mud") || is("snow") || is("sand") ||
                         is("red_sand") || is("gravel") || is("basalt");
    const Bool isWarmBeach = p.read(f.biome) != number(Biome::Beach) || p.read(f.cold) > 0.18f;
    Bool result = isEarth && p.read(f.spring) <= 0.0f && isWarmBeach && p.read(f.surface) >= p.read(f.water);
    if (p.step() == 1) result = result && p.read(f.caveTop) < p.read(f.surface) - 3;
    return result;
}

// 0…1: trees stand farther apart towards the tree line and end there. Cold lowland has the taiga's.
Float belowTreeLine(Pass& p, const Fields& f) {
    return max(smoothstep(-0.44f, -0.29f, p.read(f.cold)),
               smoothstep(kSea + 260.0f, kSea + 200.0f, p.read(f.height)));
}

}  // namespace

const vegetation::Tables& vegetationTables() {
    return kTables;
}

void plantsPass(Pass& p, const Fields& f) {
    const Bool isGround = canGrow(p, f);
    const Float share =
        select(isGround, vegetation::woodland(p, p.read(f.forest)) * beyondGlade(p) * (1.0f - clearing(p, f)),
               Float(0.0f));
    vegetation::Site site = {p.read(f.biome), share * belowTreeLine(p, f), share, p.read(f.surface), {}};
    if (p.step() <= vegetation::kMaxShapeStep)
        site.placed =
            placeShape(p, f, isGround && length(p.slope(f.height)) < 0.45f && p.read(f.wet) <= 0.0f);
    vegetation::setShapes(p, f.plants, kTables, site);
    if (p.step() > 1) return;
    vegetation::setPlants(p, f.plants, kTables,
                          {p.read(f.biome), p.read(f.top), p.read(f.water) - p.read(f.surface),
                           p.read(f.caveTop) < p.read(f.surface) - 3, p.read(f.wet), p.read(f.cold)});
}

}  // namespace terrane::gen::wilderness
