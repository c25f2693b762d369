// The store for a save, wherever it is: the file, or memory where the file cannot be written.
// Any thread, usually the one that starts a session.
#pragma once

#include <filesystem>
#include <memory>

#include "terrane/store/chunk_store.h"
#include "terrane/store/save_file.h"
#include "terrane/store/save_queue.h"

namespace terrane::store {

// As openToWrite(). Where the save or its folder cannot be written, the world runs in memory, and a message
// says so: what the file has is read, what changes is lost at the end.
[[nodiscard]] base::Result<std::unique_ptr<ChunkStore>> openStore(const std::filesystem::path& path,
                                                                  const world::BlockRegistry& registry,
                                                                  const SaveAccess& access,
                                                                  SaveLimits limits = {});

}  // namespace terrane::store
