// Passes of the generator overworld and the fields they exchange. overworld.cpp puts them together.
#pragma once

#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/language/builder.h"

namespace terrane::gen::overworld {

constexpr float kSea = kSeaLevel;
constexpr int kSoilDepth = 3;  // blocks of soil under the highest block

// Fields that passes exchange, by column. Some exist at level 0 only, lostSlope only at other levels.
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
          forest(g.field<Float>("forest")) {
        if (g.step() > 1) {
            lostSlope = g.field<Float>("lost slope");
            return;
        }
        caveTop = g.field<Int>("cave top");
        treeHeight = g.field<Int>("tree height");
        plant = g.field<Block>("plant");
        plantHeight = g.field<Int>("plant height");
    }

    Field<Float> ocean;        // above 0: sea; falls inland
    Field<Float> river;        // 0 in the middle of a river, of different signs on its sides
    Field<Float> temperature;  // -1…1
    Field<Float> desert;       // 0…1
    Field<Float> crags;        // blocks: mountains before they are bent
    Field<Float> dunes;        // 0…1, likewise
    Field<Float> height;       // of the ground, z
    Field<Int> surface;        // z of the highest ground block
    Field<Block> top, soil;    // the highest ground block, and the few below it
    Field<Float> forest;       // share of the places for trees that are taken, 0…1
    Field<Int> caveTop;        // z below which caves may be
    Field<Int> treeHeight;     // of the trunk that stands in this column, or 0
    Field<Block> plant;        // in this column above the ground, or air
    Field<Int> plantHeight;
    Field<Float> lostSlope;  // deviation along an axis of slopes that columns are too wide to show
};

// The 2D passes run in this order: fields that depend only on the position; the height; the blocks of the
// ground.
void climatePass(Pass& p, const Fields& f);
void reliefPass(Pass& p, const Fields& f);
void surfacePass(Pass& p, const Fields& f);
// The passes at level 0.
void groundPass(Pass& p, const Fields& f);      // 3D: earth, water, caves, ore
void plantsPass(Pass& p, const Fields& f);      // 2D: where trees and plants stand
void vegetationPass(Pass& p, const Fields& f);  // 3D: their blocks
// The pass at other levels.
void farPass(Pass& p, const Fields& f);  // 3D: earth, water, crowns

// Trees stand at the points of a Voronoi diagram, so that they keep their distance and a crown meets its
// neighbor's at the border between them.
constexpr int kTreeSpacing = 7;   // blocks: one tree a cell of this size at most
constexpr int kMaxCrownRise = 4;  // blocks of crown above the trunk: 4.7 / √1.7, see isLeaf
struct Tree {
    IVec2 offset;      // from here to the trunk, blocks
    Int base, height;  // of the trunk; height 0: no tree
};
Voronoi2D trees(Pass& p);
Int randomTreeHeight(Pass& p, IVec2 at);  // of the trunk, blocks
// Returns whether this voxel is leaf of the crown around (0, 0, top), whose size follows the tree's height.
Bool isLeaf(Pass& p, IVec2 offset, Int aboveTop, Int treeHeight);

// A plant other than a tree in a column; `block` is air if there is none.
struct Plant {
    Block block;
    Int height;
};
Plant plantHere(Pass& p, const Fields& f);
Plant farPlant(Pass& p, const Fields& f);  // only plants that color land from afar: wheat

}  // namespace terrane::gen::overworld
