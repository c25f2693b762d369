// The surface of a chunk of any level, seen from above: for each column the topmost block, and the block
// beneath water or a tree crown. Maps are painted from it. All are plain values; any thread may use them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/gen/generator.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::map {

// The role of a block in a view from above.
enum class SurfaceKind : std::uint8_t {
    Nothing,  // air, plants
    Liquid,
    Crown,  // cubes with holes, such as leaves and glass, and plants that shine: there may be air beneath
    Ground,
};

// By block id. Ids beyond its end are Ground.
using SurfaceKinds = std::vector<SurfaceKind>;
SurfaceKinds surfaceKinds(const world::BlockRegistry& blocks);

struct SurfaceColumn {
    world::BlockId top = world::kAir;  // the topmost block that is not Nothing; air where there is none
    // The topmost Ground at or below it, under a Crown the topmost Ground or Liquid; air if there is none.
    world::BlockId under = world::kAir;
    std::int16_t topZ = 0, underZ = 0;  // the z of these two blocks; 0 where there is none

    bool operator==(const SurfaceColumn&) const = default;
};

constexpr std::size_t kSurfaceColumns = static_cast<std::size_t>(world::kChunkSize) * world::kChunkSize;
using Surface = std::array<SurfaceColumn, kSurfaceColumns>;  // x + 16 y

Surface surfaceOf(const world::Chunk& chunk, const SurfaceKinds& kinds);
// Returns the surface of a generated chunk and generates no more of it than needed. Errors are those of
// gen::Generator::generate().
Surface surfaceOf(const gen::Generator& generator, world::ChunkPos pos, const SurfaceKinds& kinds);

}  // namespace terrane::map
