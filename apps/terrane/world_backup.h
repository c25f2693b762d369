// Writes the files of a backup while servers may run the world, for `terrane backup` and for servers of
// worlds in databases. Any thread.
#pragma once

#include <filesystem>

#include "terrane/base/result.h"
#include "terrane/io/world_options.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::app {

// Writes the world, and if servers have run it, the server's file beside it. They have all that is on disk or
// in the database at one moment. `options`: content packs that the world needs and does not remember.
[[nodiscard]] base::Result<void> writeBackup(const store::WorldLocation& world,
                                             const io::WorldOptions& options,
                                             const std::filesystem::path& save,
                                             const store::CopyProgress& progress);

}  // namespace terrane::app
