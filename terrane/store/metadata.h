// World metadata that stores write themselves, and the world's identity as text. Used by the stores.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "terrane/store/world_identity.h"

namespace terrane::store {

// Limits of a save: bytes of a name (settings and blocks), number of settings, bytes of all setting names and
// values.
constexpr std::size_t kMaxNameBytes = 1024, kMaxMetadata = 4096, kMaxMetadataBytes = std::size_t{16} << 20;

using Metadata = std::map<std::string, std::string, std::less<>>;

// Whether only stores write it: the world's identity, when a world is created or regenerated,
// kDerivedRowsMark and kChecksum.
bool isReserved(std::string_view name);

// Whether the metadata, with this value, fits the limits. The store's own rows count.
bool fitsMetadata(const Metadata& metadata, std::string_view name, std::string_view value);

// The metadata of a new world.
Metadata metadataOf(const WorldIdentity& identity);

// Fails, naming `where`, if an entry is missing or not a number.
[[nodiscard]] base::Result<WorldIdentity> identityFrom(const Metadata& metadata, const std::string& where);

}  // namespace terrane::store
