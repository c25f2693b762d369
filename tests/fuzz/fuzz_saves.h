// What fuzzers of saves share: a small save to change, and everything that programs do with a save.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/world/block_registry.h"

namespace terrane::fuzz {

// A save as a killed program leaves it: what was saved last is in the log alone.
struct SaveBytes {
    std::string file, log;
};

// Pages of 512 bytes, chunks of level 0 and above, metadata; made once.
const SaveBytes& smallSave();
// The chunks of it.
const std::vector<world::ChunkPos>& savedPositions();

// The save that lies in fuzzFolder().
std::filesystem::path savePath();
void writeSave(const SaveBytes& save);

// Looks through the save, reads it, plays in it. Aborts where reading changes a byte, or what was reported as
// saved is not there.
void useSave();

}  // namespace terrane::fuzz
