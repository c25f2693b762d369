// Packs by name or path, from the packs folder of the user. Any thread may use it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/pack/content.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/saves/world_identity.h"

namespace terrane::pack {

// Returns the folders that are searched for packs by name: $XDG_DATA_HOME/terrane/packs. The result is empty
// if no variable names a home folder.
std::vector<std::filesystem::path> packFolders();

// Reads packs by names and paths. A pack that is named twice is read once.
[[nodiscard]] base::Result<std::vector<Pack>> readPacks(const std::vector<std::string>& namesOrPaths);

// Adds the packs `names` that are not among `packs`. A pack that is not in the packs folder is left out with
// a warning: a world without it shows its blocks as missing.
[[nodiscard]] base::Result<void> addPacks(std::vector<Pack>& packs, const std::vector<std::string>& names);

// Adds required packs that are not among `packs`, from the packs folder.
[[nodiscard]] base::Result<void> addRequiredPacks(std::vector<Pack>& packs);

// Reads the same packs again from their files.
[[nodiscard]] base::Result<Content> reloadPacks(const Content& content);

// Returns the names of the packs of a world, at most 256. They are stored as the metadata "packs" of its
// save, a line "NAME VERSION HASH" each; invalid lines are skipped.
std::vector<std::string> savedPackNames(const store::Metadata& metadata);

// Stores the packs of `content`. Other names that the world has stay: it may still have blocks of a pack that
// is not loaded now.
void savePackNames(store::ChunkStore& store, const Content& content);

}  // namespace terrane::pack
