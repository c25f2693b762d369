// The parts of the overworld: its passes and what they hand on. The generator itself is in overworld.cpp.
#pragma once

#include "terrane/gen/builder.h"
#include "terrane/gen/generators/sea_level.h"

namespace terrane::gen::overworld {

constexpr float kSea = kSeaLevel;
constexpr int kSoilDepth = 3;  // blocks of soil under the highest block

// What the passes hand on, by column.
struct Fields {
    explicit Fields(GeneratorBuilder& g)
        : ocean(g.field<Float>("ocean")),
          river(g.field<Float>("river")),
          temperature(g.field<Float>("temperature")),
          desert(g.field<Float>("desert")),
          crags(g.field<Float>("crags")),
          dunes(g.field<Float>("dunes")),
          height(g.field<Float>("height")),
          surface(g.field<Int>("surface")),
          top(g.field<Block>("top")),
          soil(g.field<Block>("soil")),
          caveTop(g.field<Int>("cave top")),
          forest(g.field<Float>("forest")),
          treeHeight(g.field<Int>("tree height")),
          plant(g.field<Block>("plant")),
          plantHeight(g.field<Int>("plant height")) {}

    Field<Float> ocean;        // above 0: sea; falls inland
    Field<Float> river;        // 0 in the middle of a river, of different signs on its sides
    Field<Float> temperature;  // -1…1
    Field<Float> desert;       // 0…1
    Field<Float> crags;        // blocks: mountains before they are bent
    Field<Float> dunes;        // 0…1, likewise
    Field<Float> height;       // of the ground, z
    Field<Int> surface;        // z of the highest ground block
    Field<Block> top, soil;    // the highest ground block, and the few below it
    Field<Int> caveTop;        // z below which caves may be
    Field<Float> forest;       // share of the places for trees that are taken, 0…1
    Field<Int> treeHeight;     // of the trunk that stands in this column, or 0
    Field<Block> plant;        // in this column above the ground, or air
    Field<Int> plantHeight;
};

// 2D, in this order: what only depends on the position; the height; what the ground is made of.
void climatePass(Pass& p, const Fields& f);
void reliefPass(Pass& p, const Fields& f);
void surfacePass(Pass& p, const Fields& f);
void groundPass(Pass& p, const Fields& f);      // 3D: earth, water, caves, ore
void plantsPass(Pass& p, const Fields& f);      // 2D: where trees and plants stand
void vegetationPass(Pass& p, const Fields& f);  // 3D: their blocks

}  // namespace terrane::gen::overworld
