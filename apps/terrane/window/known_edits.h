// Writes a client's knowledge of a server's world as text: tools/soak.py compares it with the world.
#pragma once

#include <filesystem>

#include "terrane/net/remote_store.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/pose.h"

namespace terrane::app {

// Covers chunks up to `reach` chunks from that of `pose`: a line "center X Y" with that chunk, then "X Y Z
// NAME" for each block that differs from the generated one. Overwrites `file`.
[[nodiscard]] base::Result<void> writeKnownEdits(const std::filesystem::path& file, net::RemoteStore& store,
                                                 const world::BlockRegistry& blocks, const world::Pose& pose,
                                                 int reach);

}  // namespace terrane::app
