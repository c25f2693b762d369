// The blocks that an export writes: from a world, else generated. Called by the export commands on their
// thread.
#pragma once

#include <memory>

#include "apps/terrane/formats/export_options.h"
#include "terrane/base/job_system.h"
#include "terrane/base/result.h"
#include "terrane/formats/block_volume.h"
#include "terrane/gen/generator.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::app {

struct ExportSource {
    std::shared_ptr<const world::BlockRegistry> blocks;
    world::TextureSource textures;
    std::unique_ptr<store::ChunkStore> save;  // may be null
    gen::Generator generator;
    world::BlockBox box;  // all blocks to be written, within the world's heights
};

// `options` get the world's seed and generator.
[[nodiscard]] base::Result<ExportSource> openExport(ExportOptions& options);

// Calls `take` for the blocks of the box chunk by chunk, until it fails or somebody stops the program.
using TakeChunk = std::function<base::Result<void>(world::ChunkPos pos, const world::Chunk& chunk)>;
[[nodiscard]] base::Result<void> forEachChunk(const ExportOptions& options, const ExportSource& source,
                                              const TakeChunk& take);

// The chunks that the box touches.
[[nodiscard]] world::ChunkArea chunksOf(const world::BlockBox& box);

// All blocks of the box; an error where it is too large for memory (formats::kMaxVolumeBlocks).
[[nodiscard]] base::Result<formats::BlockVolume> readVolume(const ExportOptions& options,
                                                            const ExportSource& source);

}  // namespace terrane::app
