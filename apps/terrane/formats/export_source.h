// Provides the blocks of an export, from a world or generated. Called by the export commands on their thread.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/terrane/options.h"
#include "terrane/base/job_system.h"
#include "terrane/base/result.h"
#include "terrane/formats/block_volume.h"
#include "terrane/gen/generator.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/coords.h"

namespace terrane::app {

// Options of `terrane export`. A plain value.
struct ExportOptions {
    std::string output;
    WorldOptions world;
    SaveOptions save;
    std::optional<world::ChunkArea> area;  // all heights; or `box`
    std::string box;                       // "X0,Y0,Z0,X1,Y1,Z1" in blocks, the end excluded
    std::string mapping;                   // for a schematic
    std::string resourcePack;              // for formats with colors or textures
    int bits = 8;                          // per pixel of a height map
};

struct ExportSource {
    std::shared_ptr<const world::BlockRegistry> blocks;
    world::TextureSource textures;
    std::unique_ptr<store::ChunkStore> save;  // may be null
    gen::Generator generator;
    world::BlockBox box;  // the blocks to write, within the world's heights
};

// Sets seed and generator in `options` to the world's.
[[nodiscard]] base::Result<ExportSource> openExport(ExportOptions& options);

// Calls `take` for each chunk of the box, until it fails or a signal stops the program.
using TakeChunk = std::function<base::Result<void>(world::ChunkPos pos, const world::Chunk& chunk)>;
[[nodiscard]] base::Result<void> forEachChunk(const ExportOptions& options, const ExportSource& source,
                                              const TakeChunk& take);

// The chunks that intersect the box.
[[nodiscard]] world::ChunkArea chunksOf(const world::BlockBox& box);

// All blocks of the box; fails if there are more than formats::kMaxVolumeBlocks.
[[nodiscard]] base::Result<formats::BlockVolume> readVolume(const ExportOptions& options,
                                                            const ExportSource& source);

}  // namespace terrane::app
