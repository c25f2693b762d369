// The world that an import writes into: its blocks, store and generators. Called by the import commands.
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

// First, so that what is wrong with a mapping is told before a world is made.
[[nodiscard]] base::Result<pack::Content> loadImportContent(const ImportOptions& options);
// Made where it is not there. Tiles seen from afar follow what is saved. `options` get its seed and
// generator.
[[nodiscard]] base::Result<ImportWorld> openImportWorld(ImportOptions& options, pack::Content content);

}  // namespace terrane::app
