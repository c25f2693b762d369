// Passes of the generator continents and the fields they exchange. continents.cpp puts them together.
#pragma once

#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/vegetation.h"
#include "terrane/gen/language/builder.h"

namespace terrane::gen::continents {

constexpr float kSea = kSeaLevel;

// Blocks from one warm belt to the next, along y.
constexpr int kClimatePeriod = 32768;

// In the order of their numbers in Fields::biome.
enum class Biome {
    Ocean,
    Reef,
    Beach,
    Meadow,
    OakForest,
    BirchForest,
    OldForest,
    Taiga,
    Tundra,
    Snow,
    Savanna,
    Desert,
    CanyonLand,
    Swamp,
    Alpine,
    RainForest,
    Count
};
const char* biomeName(Biome biome);
inline Int number(Biome biome) {
    return Int(static_cast<int>(biome));
}

// What grows in each biome (continents_plants.cpp).
const vegetation::Tables& vegetationTables();

// Returns the map that rivers and lakes follow (continents_relief.cpp).
Drainage rivers(GeneratorBuilder& g);

// Fields that passes exchange, by column.
struct Fields {
    explicit Fields(GeneratorBuilder& g)
        : land(g.field<Float>("land")),
          temperature(g.field<Float>("temperature")),
          moisture(g.field<Float>("moisture")),
          mountains(g.field<Float>("mountains")),
          volcanic(g.field<Float>("volcanic")),
          base(g.field<Float>("base")),
          height(g.field<Float>("height")),
          rocky(g.field<Float>("rocky")),
          wet(g.field<Float>("wet")),
          cold(g.field<Float>("cold")),
          forest(g.field<Float>("forest")),
          water(g.field<Int>("water")),
          surface(g.field<Int>("surface")),
          biome(g.field<Int>("biome")),
          top(g.field<Block>("top")),
          soil(g.field<Block>("soil")),
          rock(g.field<Block>("rock")),
          color(g.field<Int>("color")),
          rivers(continents::rivers(g)),
          plants(g, vegetationTables()) {
        if (g.step() == 1) caveTop = g.field<Int>("cave top");
    }

    Field<Float> land;         // above 0: land, rises inland; 1 is about 4 km from the coast
    Field<Float> temperature;  // -1…1, at sea level
    Field<Float> moisture;     // -1…1
    Field<Float> mountains;    // 0…1: part of a range
    Field<Float> volcanic;     // 0…1: from a volcano's foot to its middle
    Field<Float> base;         // z of the ground before erosion and rivers
    Field<Float> height;       // z of the ground
    Field<Float> rocky;        // 0…1: cliffs of canyon lands, volcanoes, karst: bare whatever their slope
    Field<Float> wet;          // 0…1: in a river or lake, or on its bank
    Field<Float> cold;         // the temperature at the ground's height
    Field<Float> forest;       // 0…1: share of the possible vegetation that grows here
    Field<Int> water;          // z of the highest water, where the ground is lower
    Field<Int> surface;        // z of the highest ground block
    Field<Int> biome;
    Field<Block> top, soil, rock;  // the highest block, the few below it, and all below these
    Field<Int> color;              // of grass and leaves, as a tint has it
    Field<Int> caveTop;            // z below which caves may be; at level 0
    Drainage rivers;
    vegetation::Fields plants;
};

// The large landforms, from the position alone.
struct Shape {
    Float land, temperature, moisture, mountains, volcanic;
    Float base;
};
Shape shape(Pass& p);
// Returns the part of the base height that rivers follow: land, ranges and volcanoes.
Float coarseHeight(Pass& p);

// These return the weight of the landforms of a climate, 0…1.
Float canyonLand(Float temperature, Float moisture);
Float desert(Float temperature, Float moisture);
Float karst(Float temperature, Float moisture);

// The 2D passes run in this order.
void shapePass(Pass& p, const Fields& f);
void reliefPass(Pass& p, const Fields& f);
void surfacePass(Pass& p, const Fields& f);
// A 2D pass for the tint alone.
void colorPass(Pass& p, const Fields& f);
// Returns the block of earth, caves and water at this voxel of a 3D pass.
Block ground(Pass& p, const Fields& f);

// The passes of vegetation (continents_plants.cpp).
void plantsPass(Pass& p, const Fields& f);    // 2D: where
void landPass(Pass& p, const Fields& f);      // 3D: on the ground
void caveLifePass(Pass& p, const Fields& f);  // 3D: in caves

// The result of cutting rivers and lakes (continents_relief.cpp).
struct RiverCut {
    Float height;   // of the ground
    Int water;      // z of the highest water where the ground is lower
    Float isWater;  // 0…1: river, lake or their bank
};
// Cuts valleys, beds and basins into ground of the given height.
RiverCut cutRivers(Pass& p, const Fields& f, Float height);

}  // namespace terrane::gen::continents
