// Passes of the generator wilderness and the fields they exchange. wilderness.cpp puts them together.
#pragma once

#include <optional>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/ruins.h"
#include "terrane/gen/generators/vegetation.h"
#include "terrane/gen/language/builder.h"

namespace terrane::gen::wilderness {

constexpr int kSeaZ = 0;      // z of the highest water of the sea
constexpr int kCloudZ = 640;  // where clouds float: below the peaks of ranges, whose median is 1,015
constexpr float kSea = static_cast<float>(kSeaZ);

// In the order of their numbers in Fields::biome.
enum class Biome {
    DeepOcean,
    Ocean,
    KelpForest,
    Reef,
    Beach,
    StonyShore,
    Mangrove,
    Meadow,
    Steppe,
    OakForest,
    BeechForest,
    BirchForest,
    MapleForest,
    OldForest,
    GiantForest,
    Swamp,
    Bog,
    Taiga,
    FirForest,
    LarchForest,
    Tundra,
    Snow,
    Glacier,
    AlpineMeadow,
    Rocks,
    Savanna,
    Shrubland,
    Desert,
    Badlands,
    RainForest,
    CloudForest,
    BambooForest,
    CherryGrove,
    LavaField,
    Count
};
const char* biomeName(Biome biome);
inline Int number(Biome biome) {
    return Int(static_cast<int>(biome));
}

// Caves (wilderness_underground.cpp): storeys of rooms and passages, each open between a floor and a roof, by
// column.
constexpr int kStoreys = 5, kNoLake = -10001;
struct Storey {
    Field<Int> floor, roof;          // z of the highest ground and of the lowest rock above it
    Field<Int> wallFloor, wallRoof;  // z between which the rock is that of the storey's walls
    Field<Int> lake;                 // z of the water where the storey is open
    Field<Block> wall, ground, pool;
};
struct CaveFields {
    explicit CaveFields(GeneratorBuilder& g);

    Storey storeys[kStoreys];
    Field<Int> mushroomLow, mushroomHigh;
    // A river below a stream; z above which, up to the water, no other cave opens its bed.
    Field<Int> riverFloor, riverRoof, riverTop, riverSeal;
};
// At the foot of a fall the second block from the surface is foam: white water fills its cell, the surface of
// water lies lower. All falls are higher.
constexpr int kFoamMark = 2;
constexpr int kShaftMark = 64;  // blocks of `caveTop` above the surface in shafts

// Rare places (wilderness_places.cpp). Fields::placeKind has their numbers.
enum class Place { Arch, SeaArch, Sinkhole, HotSprings, GiantTree, Ruins, Count };
// Up to these steps columns have rock above open ground, and are open below the sea's cliffs.
constexpr int kMaxArchStep = 8, kMaxNotchStep = 2;

// Fields that passes exchange, by column. Shares are 0…1.
struct Fields {
    explicit Fields(GeneratorBuilder& g);

    // The large forms, from the position alone.
    Field<Float> land;               // above 0: land; 1 is some 4 km from the coast
    Field<Float> range;              // share: part of a mountain range
    Field<Float> hilly;              // share: how much of the lowland is hills
    Field<Float> table;              // share: table land
    Field<Float> rangeLine;          // 0 on the main ridges of ranges
    Field<Float> temperature, rain;  // −1…1, at sea level; rain without the shadows of ranges
    // The ground.
    Field<Float> moisture;  // −1…1
    Field<Float> canyon;    // share: table land that rivers have cut canyons into
    Field<Float> volcanic;  // share: from a volcano's foot to its middle
    Field<Int> craterLake;  // z of the lake of a crater, or less than all ground
    Field<Bool> isLava;     // such lakes
    Field<Float> base;      // z before gullies and rivers
    Field<Float> fan;       // share: gravel of an alluvial fan
    // The streams around, see ValleySample: blocks to them, z.
    Field<Float> fromStream, streamLevel;
    Field<Float> sides;   // blocks a block that the sides of valleys rise here, but on divides
    Field<Float> height;  // z
    Field<Float> rocky;   // share: bare whatever its slope
    Field<Float> wet;     // share: in a river or lake, or on its bank
    Field<Int> water;     // z of the highest water, where the ground is lower
    Field<Int> fall;      // blocks of white water, down from `water`: of a fall; or kFoamMark
    Field<Int> surface;   // z of the highest ground block
    // The place of this square of the land: its kind or -1, and blocks to its point.
    Field<Int> placeKind, placeX, placeY;
    Field<Float> spring;             // 0, or 1 + where in a terrace of hot springs
    Field<Int> archLow, archHigh;    // z of rock above open ground, if any
    Field<Int> notchLow, notchHigh;  // z between which the ground is open, if it is
    // What it is made of and what grows on it.
    Field<Int> biome;
    Field<Float> cold;                // the temperature at the ground's height
    Field<Float> forest;              // share of the possible vegetation
    Field<Block> top, soil, rock;     // the highest block, the few below it, and all below these
    Field<Int> caveTop;               // z below which caves may be; at level 0
    std::optional<CaveFields> caves;  // at level 0
    Field<Int> hidden;                // z below which nobody sees what rock is like; at other levels
    Field<Int> color;                 // of grass and leaves, as a tint has it
    Drainage rivers;
    vegetation::Fields plants;
    ruins::RuinRecord ruins;
};

// What grows in each biome (wilderness_plants.cpp).
const vegetation::Tables& vegetationTables();

// The land that rivers find their way over, and how steep a stream of one node is on it
// (wilderness_forms.cpp).
Drainage rivers(GeneratorBuilder& g);

// The 2D passes run in this order.
void formsPass(Pass& p, const Fields& f);  // wilderness_forms.cpp
void basePass(Pass& p, const Fields& f);   // wilderness_relief.cpp
void reliefPass(Pass& p, const Fields& f);
void surfacePass(Pass& p, const Fields& f);       // wilderness_surface.cpp
void plantsPass(Pass& p, const Fields& f);        // wilderness_plants.cpp
void underSurfacePass(Pass& p, const Fields& f);  // wilderness_underground.cpp; at level 0
// A 2D pass for the tint alone.
void colorPass(Pass& p, const Fields& f);

// Blocks by which strata are bent up or down.
Float bendOfStrata(Pass& p);
// Returns the block of earth, caves, water and plants at this voxel of a 3D pass (wilderness_ground.cpp).
Block landBlock(Pass& p, const Fields& f);
// For level 0 (wilderness_underground.cpp): whether a cave is open to the sky here; rock with caves and what
// is in them; rock with veins of ore; what grows on the ground of caves.
Bool isShaft(Pass& p, const Fields& f);
Block withCaves(Pass& p, const Fields& f, Block rock);
Block withOre(Pass& p, const Fields& f, Block rock);
void caveLifePass(Pass& p, const Fields& f);

// Where a column has rock above open ground, or open rock; low > high where it has not.
struct Span {
    Int low, high;
};
constexpr int kNoSpan = 10000;

// Places. The first sets the fields of the square; the others change the ground and what stands on it.
void setPlace(Pass& p, const Fields& f);
Float withPlaces(Pass& p, const Fields& f, Float ground);
void addSprings(Pass& p, const Fields& f, Var<Float>& height, Var<Int>& water, Var<Float>& spring);
Block springGround(Pass& p, Float spring, Block ground);
Float clearing(Pass& p, const Fields& f);  // share: trees leave it free
Int placeShape(Pass& p, const Fields& f,
               Bool canStand);  // of a giant tree or ruins whose foot is here, or -1
Span archAt(Pass& p, const Fields& f);
// Blocks from the wall of a sinkhole that has at least this share of its depth here; many if there is none.
Float besideSinkhole(Pass& p, const Fields& f, float least);
// Cliffs at the sea (wilderness_coast.cpp).
Float withStacks(Pass& p, const Fields& f, Float ground);
Span notchAt(Pass& p, const Fields& f);
void archesPass(Pass& p, const Fields& f);  // 2D, up to kMaxArchStep

// Share: limestone is below.
Float limestoneShare(Pass& p, const Fields& f);
// A cone with a crater, of the coarse heights and of the ground alike (wilderness_volcano.cpp).
struct Volcano {
    Float height;    // z
    Float rise;      // blocks above the land around
    Float share;     // 0…1: from its foot to its middle
    Int lake;        // z of the surface of its crater's lake, at columns in the crater; -kNoSpan for none
    Bool isLava;     // what the lake is of
    Float toX, toY;  // blocks to its middle
};
Volcano volcanoAt(Pass& p);
// Blocks that tongues of lava and cinder cones add to its ground; valleys between its ribs, 0 or less.
Float flanksOf(Pass& p, const Volcano& volcano);
Float barrancos(Pass& p, const Fields& f, Vec2 slope);
// Shares of the landforms of a climate: canyons, dunes, limestone towers.
Float dryLand(Float temperature, Float moisture);
Float sandLand(Float temperature, Float moisture);
Float karstLand(Float temperature, Float moisture);

}  // namespace terrane::gen::wilderness
