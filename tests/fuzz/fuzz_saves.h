// Shared by fuzzers of saves: a small save to change, and a run of all uses of a save.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::fuzz {

// A save as left by a killed program: the last transactions are only in the log.
struct SaveBytes {
    std::string file, log;
};

// A save with pages of 512 bytes, chunks of level 0 and above, and metadata; made once.
const SaveBytes& smallSave();
const SaveBytes& tallSave();  // the same of the layers -64 to 319
// The positions of its chunks.
const std::vector<world::ChunkPos>& savedPositions();

// The save in fuzzFolder().
std::filesystem::path savePath();
void writeSave(const SaveBytes& save);

// Checks the save, reads it, and plays in it. Aborts if reading changes a byte, or if data reported as saved
// is missing.
void useSave();

}  // namespace terrane::fuzz
