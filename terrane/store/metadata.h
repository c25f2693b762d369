// The metadata of a world that are its identity, and how they are written as texts. Used by the stores.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "terrane/store/world_identity.h"

namespace terrane::store {

using Metadata = std::map<std::string, std::string, std::less<>>;

// Whether the name is one that a world's identity is read from. Only creating and regenerating a world write
// these.
bool isPartOfIdentity(std::string_view name);

// The metadata of a new world.
Metadata metadataOf(const WorldIdentity& identity);

// An error that names `where`, if one is missing or no number.
[[nodiscard]] base::Result<WorldIdentity> identityFrom(const Metadata& metadata, const std::string& where);

}  // namespace terrane::store
