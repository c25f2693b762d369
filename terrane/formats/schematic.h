// Schematics: a box of Minecraft's blocks in a file. Sponge's format (.schem), versions 1 to 3, and the older
// one of MCEdit (.schematic) with numbers. Called by `terrane import` and `terrane export`. Plain functions;
// any thread.
//
// Minecraft's x, y, z are our x, z, -y: the row with the largest z comes first.
#pragma once

#include <string>
#include <string_view>

#include "terrane/base/result.h"
#include "terrane/formats/block_volume.h"
#include "terrane/formats/legacy_ids.h"

namespace terrane::formats {

// Of a schematic's NBT when decompressed: 2^25 blocks of up to 3 bytes, and what stands beside them.
constexpr std::size_t kMaxSchematicBytes = std::size_t{128} << 20;

// Of a gzip file. Damaged where it is none, Unsupported where it is of another version. Entities, contents of
// chests and the offset are left out. Messages name no file.
[[nodiscard]] base::Result<NamedVolume> decodeSchematic(std::string_view bytes, const LegacyIds& ids);

// Version 2 of Sponge's format, compressed. Sides have at most 65,535 blocks. The same volume gives the same
// bytes with one version of zlib.
[[nodiscard]] base::Result<std::string> encodeSchematic(const NamedVolume& volume);

}  // namespace terrane::formats
