// Opens the world that an import writes into, with its blocks, store and generators. Called by the import
// commands.
#pragma once

#include <memory>
#include <optional>

#include "apps/terrane/formats/import_options.h"
#include "terrane/base/result.h"
#include "terrane/gen/level_generators.h"
#include "terrane/pack/content.h"
#include "terrane/store/chunk_store.h"

namespace terrane::app {

struct ImportWorld {
    pack::Content content;
    std::unique_ptr<gen::LevelGenerators> generators;  // outlives the store
    std::unique_ptr<store::ChunkStore> store;
};

// `content`: loaded by the caller first, so that errors of a mapping are found before a world is created.
// Opens the world, creating it if needed; sets seed and generator in `options` to its own. Distant tiles
// follow the imported chunks.
[[nodiscard]] base::Result<ImportWorld> openImportWorld(ImportOptions& options, pack::Content content);

}  // namespace terrane::app
