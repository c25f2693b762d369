// The records of a world in a file: a database beside it. Used by both builds of world_records.h.
#pragma once

#include "terrane/net_postgres/world_records.h"

namespace terrane::net_postgres {

[[nodiscard]] base::Result<WorldRecords> openFileRecords(const store::WorldLocation& world,
                                                         const world::BlockRegistry& blocks);
[[nodiscard]] base::Result<net::History> openFileHistory(const store::WorldLocation& world,
                                                         const world::BlockRegistry& blocks);
[[nodiscard]] bool hasFileRecords(const store::WorldLocation& world);
// serverFilesOf() for a world in a file.
[[nodiscard]] base::Result<std::filesystem::path> filesBeside(const store::WorldLocation& world);

}  // namespace terrane::net_postgres
