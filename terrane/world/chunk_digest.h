// The digest of chunks that `terrane generate --digest` prints and Python's World.digest() returns. Any
// thread.
#pragma once

#include "terrane/base/digest.h"
#include "terrane/world/chunk.h"

namespace terrane::world {

// Adds a chunk's blocks by z, y, x, as 16-bit little-endian ids. Block state and block entity data do not
// count. The digest of an area takes its chunks by y, then x.
void addToDigest(base::Digest& digest, const Chunk& chunk);

}  // namespace terrane::world
