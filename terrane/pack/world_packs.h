// The packs of a world, stored as the metadata "packs" of its save, a line "NAME VERSION HASH" each. Any
// thread.
#pragma once

#include <string>
#include <vector>

#include "terrane/pack/content.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/metadata.h"

namespace terrane::pack {

// The names, at most 256; invalid lines are left out.
std::vector<std::string> rememberedPacks(const store::Metadata& metadata);

// Stores the packs of `content`. Other names that the world has stay: it may still have blocks of a pack that
// is not loaded now.
void rememberPacks(store::ChunkStore& store, const Content& content);

}  // namespace terrane::pack
