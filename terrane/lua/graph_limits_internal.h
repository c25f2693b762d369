// Limits of the generators that scripts record, beside those of running scripts (budget.h).
#pragma once

#include <cstddef>
#include <string>

#include "terrane/gen/compile/generator_graph.h"

namespace terrane::lua {

// Limits of the generator that a script records. The larger generators of the program have some 3,000 nodes a
// pass. All passes together have at most 100,000 nodes: Limits::steps / 40, the steps of a node (call.cpp).
constexpr std::size_t kMaxNodesInPass = 20'000;
constexpr std::size_t kMaxPasses = 32;
constexpr std::size_t kMaxFields = 128;
constexpr std::size_t kMaxVariablesInPass = 256;
constexpr std::size_t kMaxSeedNames = 512;  // noises and random numbers: the builder looks through them
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::size_t kMaxDrainages = 4;
constexpr std::size_t kMaxVoxels = 200'000;  // in all shapes together
constexpr std::size_t kMaxLoopDepth = 2;

// Work of the slowest chunk in operations, where each loop runs 1,024 rounds: 65,536 voxels, which are 256
// layers, × 100,000 operations take some 2 s. Chunks of a taller world have more voxels with fewer
// operations.
constexpr double kMaxOperationsOfChunk = 65'536 * 100'000.0;
// Heights of one region of a drainage map: (128 + 2 · 88)² cells with 4 samples each
// (gen/drainage/drainage_curves.cpp). A chunk at a corner needs four regions.
constexpr double kColumnsOfRegion = 369'664;
constexpr double kRegionsOfChunk = 4;
// Rings of chunks around one that are made before it: (2 · 6 + 1)² = 169 chunks.
constexpr int kMaxRings = 6;
// 3D passes whose blocks are kept for neighbors: 8 KiB each for a section that is not one block, for 256
// chunks and more of each level, up to the most memory that gen::CacheSize has.
constexpr std::ptrdiff_t kMaxKeptBlocks = 2;

// Bounds the time that a chunk of a recorded generator takes. script.cpp checks each script's. Any thread may
// call it. Returns the reason if a chunk may take too long, else an empty string. The graph has no mistakes.
// Stamps count once it has its table of shapes.
std::string unboundedWork(const gen::GeneratorGraph& graph);

}  // namespace terrane::lua
