// Tables of the trees and plants that grow in each biome of continents. continents_plants.cpp uses it.
#pragma once

#include <span>

#include "terrane/gen/generators/continents.h"
#include "terrane/gen/generators/trees/trees.h"

namespace terrane::gen::continents {

// The share of the scattered points of a biome at which one stands, where its forest is whole.
struct Grove {
    Biome biome;
    trees::Kind kind;
    float share;
};
std::span<const Grove> treeGroves();   // points kTreeSpacing apart
std::span<const Grove> smallGroves();  // bushes, boulders, logs; points kSmallSpacing apart
constexpr int kTreeSpacing = 7, kSmallSpacing = 9;

// The share of a biome's columns in which a plant of one block stands.
struct Plant {
    Biome biome;
    const char* block;
    float share;
};
std::span<const Plant> plants();

}  // namespace terrane::gen::continents
