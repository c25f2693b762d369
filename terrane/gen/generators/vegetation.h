// Trees, bushes, stones and plants of a generator with biomes, from tables: which grow where, at every level.
//
// Up to kMaxShapeStep the same shapes stand at scattered points; with wider columns, columns are crowns as
// often as crowns cover the ground.
#pragma once

#include <optional>
#include <span>

#include "terrane/gen/generators/trees/trees.h"
#include "terrane/gen/language/builder.h"

namespace terrane::gen::vegetation {

// A number of a biome, from an enumeration of a generator.
struct BiomeNumber {
    int value;
    template <class Biome>
    constexpr BiomeNumber(Biome biome) : value(static_cast<int>(biome)) {}
    friend bool operator==(BiomeNumber, BiomeNumber) = default;
};

// The share of the scattered points of a biome at which one stands, where its forest is whole.
struct Grove {
    BiomeNumber biome;
    trees::Kind kind;
    float share;
};
constexpr int kTreeSpacing = 7, kSmallSpacing = 9;  // blocks between points

// The share of a biome's columns in which a plant of one block stands.
struct Plant {
    BiomeNumber biome;
    const char* block;
    float share;
};

struct Tables {
    std::span<const Grove> trees;  // at points kTreeSpacing apart
    std::span<const Grove> small;  // bushes, boulders, logs; kSmallSpacing apart
    std::span<const Plant> plants;
    int biomes;                                // their number
    std::span<const BiomeNumber> inWater;      // biomes whose plants grow in water…
    int deepest;                               // …less deep than this, in blocks
    BiomeNumber cacti;                         // the biome where they grow
    std::span<const trees::Kind> placed = {};  // kinds that the generator itself places, see Site
};

// Up to this step shapes are stamped, and those smaller than trees up to kMaxSmallStep.
constexpr int kMaxShapeStep = 4, kMaxSmallStep = 2;
// Returns whether columns hold a plant, or a crown, of their own.
constexpr bool hasPlants(int step) {
    return step == 1 || step > kMaxShapeStep;
}

// By column. The level decides which of them there are.
struct Fields {
    Fields(GeneratorBuilder& g, const Tables& tables);

    trees::TreeKinds kinds;  // those of the tables
    Field<Int> tree, small;  // numbers of the shapes that stand in this column, or -1
    Field<Int> treeBase;     // z of their feet
    Field<Block> plant;      // on the ground, or air
    Field<Int> plantHeight;
};

struct Site {
    Int biome;
    Float share, smallShare;         // 0…1: of the shares of trees, and of small things, in the tables
    Int surface;                     // z of the highest ground block
    std::optional<Int> placed = {};  // number of a shape that stands here whatever the tables say, or -1
};

// Writes all fields but, at step 1, the plants: these are the generator's.
void setShapes(Pass& p, const Fields& f, const Tables& tables, const Site& site);

// Where a column's plant would stand.
struct PlantSite {
    Int biome;
    Block top;        // of the ground
    Int depth;        // blocks of water above it; 0 or less where it is dry
    Bool isFree;      // no cave is near
    Float wet, cold;  // share: on the bank of a river; the temperature
};
// Writes the plant of the table in this column, reeds on banks, or a cactus; at step 1.
void setPlants(Pass& p, const Fields& f, const Tables& tables, const PlantSite& site);

// Returns `forest`, the share of the vegetation that a column can have, less what woods and clearings leave.
Float woodland(Pass& p, Float forest);

// Returns the block at a voxel above the ground, where there is `open`, air or water, beside plants and trees
// (3D passes).
Block aboveGround(Pass& p, const Fields& f, Int surface, Block open);
// Returns the block of plants and trees at this voxel, where the ground block is `ground` (3D passes).
Block overGround(Pass& p, const Fields& f, Int surface, Block ground);

// Returns the color of grass and leaves, as a tint has it, by the temperature at the ground and the moisture.
Int grassColor(Pass& p, Float temperature, Float moisture);

}  // namespace terrane::gen::vegetation
