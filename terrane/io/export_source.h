// Provides the blocks of an export, from a world or generated. One thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>

#include "terrane/base/result.h"
#include "terrane/formats/block_volume.h"
#include "terrane/gen/generator.h"
#include "terrane/io/world_options.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/coords.h"

namespace terrane::io {

struct ExportOptions {
    WorldOptions world;
    SaveOptions save;
    // The blocks to write: all heights of an area of chunks, or a box.
    std::variant<world::ChunkArea, world::BlockBox> blocks;
    std::string resourcePack;  // folder, for formats with colors or textures; empty: none
};

struct ExportSource {
    std::shared_ptr<const world::BlockRegistry> blocks;
    world::TextureSource textures;
    std::unique_ptr<store::ChunkStore> save;  // may be null
    gen::Generator generator;
    world::BlockBox box;  // the blocks to write
    unsigned threads = 1;
};

// Sets seed, generator and heights in `options` to the world's. Fails if the box is not within the heights.
[[nodiscard]] base::Result<ExportSource> openExport(ExportOptions& options);

// Calls `take` for each chunk of the box, until it fails or `progress` stops it.
using TakeChunk = std::function<base::Result<void>(world::ChunkPos pos, const world::Chunk& chunk)>;
[[nodiscard]] base::Result<void> forEachChunk(const ExportSource& source, const Progress& progress,
                                              const TakeChunk& take);

// The chunks that intersect the box.
[[nodiscard]] world::ChunkArea chunksOf(const world::BlockBox& box);

// All blocks of the box; fails if there are more than formats::kMaxVolumeBlocks.
[[nodiscard]] base::Result<formats::BlockVolume> readVolume(const ExportSource& source,
                                                            const Progress& progress = {});

}  // namespace terrane::io
