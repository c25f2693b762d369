// Worlds for the meshing benchmark, small squares of chunks: what others measure with, the reference scenes,
// and the worst cases.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::bench {

constexpr int kGrid = 8;  // chunks along x and y that are meshed, one row more around them

// The chunks of an input, and what the mesher takes of each.
struct MeshWorld {
    explicit MeshWorld(std::vector<world::Chunk> all) : chunks(std::move(all)) {}
    std::vector<mesh::MeshInput> inputs(const mesh::MeshOptions& options) const;

    std::vector<world::Chunk> chunks;  // (kGrid + 2)², rows along x
};

struct NamedInput {
    const char* name;
    MeshWorld (*make)();
};

std::span<const NamedInput> meshInputs();

}  // namespace terrane::bench
