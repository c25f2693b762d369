// The metadata of a world that stores write themselves, and its identity as texts. Used by the stores.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "terrane/store/world_identity.h"

namespace terrane::store {

// A save has no more: names of settings and of blocks, how many settings, and all their names and values.
constexpr std::size_t kMaxNameBytes = 1024, kMaxMetadata = 4096, kMaxMetadataBytes = std::size_t{16} << 20;

using Metadata = std::map<std::string, std::string, std::less<>>;

// Whether stores alone write it: a world's identity, by creating and regenerating a world, kDerivedRowsMark
// and kChecksum.
bool isReserved(std::string_view name);

// Whether a save keeps the metadata with this value too. The store's own rows count.
bool fitsMetadata(const Metadata& metadata, std::string_view name, std::string_view value);

// The metadata of a new world.
Metadata metadataOf(const WorldIdentity& identity);

// An error that names `where`, if one is missing or no number.
[[nodiscard]] base::Result<WorldIdentity> identityFrom(const Metadata& metadata, const std::string& where);

}  // namespace terrane::store
