// The heights that a world has unless it says otherwise, 0…255, as numbers for tests and benchmarks.
#pragma once

#include "terrane/world/coords.h"

namespace terrane::world {

constexpr int kChunkHeight = Heights().layers();
constexpr int kSectionsPerChunk = Heights().sections();
constexpr int kBlocksPerChunk = kChunkHeight * kBlocksPerLayer;

}  // namespace terrane::world
