// Schematics, files with a box of Minecraft's blocks: Sponge's format (.schem), versions 1 to 3, and the
// older one of MCEdit (.schematic) with numbers. `terrane import` and `terrane export` call it. The functions
// have no state; any thread may call them.
//
// Minecraft's x, y, z are our -x, z, y: the blocks of a row along x are in reverse order.
#pragma once

#include <string>
#include <string_view>

#include "terrane/base/result.h"
#include "terrane/formats/block_mapping.h"
#include "terrane/formats/block_volume.h"

namespace terrane::formats {

// The limit for a schematic's decompressed NBT: 2^25 blocks of up to 3 bytes and the other tags.
constexpr std::size_t kMaxSchematicBytes = std::size_t{128} << 20;

// Reads a gzip file. Returns Damaged if it is no schematic, Unsupported if it has another version. Entities,
// contents of chests and the offset are left out. Messages name no file.
[[nodiscard]] base::Result<NamedVolume> decodeSchematic(std::string_view bytes, const LegacyIds& ids);

// Writes version 2 of Sponge's format, compressed. Returns BadInput if a side has more than 65,535 blocks.
// The same volume gives the same bytes with one version of zlib.
[[nodiscard]] base::Result<std::string> encodeSchematic(const NamedVolume& volume);

}  // namespace terrane::formats
