// Provides the blocks of an export, from a world or generated. Called by the export commands on their thread.
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
