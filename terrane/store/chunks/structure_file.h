// Structures (world/changes/structure.h) as files, NAME.structure. docs/structure-format.md describes the
// bytes. The functions have no state; any thread may call them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/world/changes/structure.h"

namespace terrane::store {

constexpr std::uint8_t kStructureVersion = 1;

constexpr std::size_t kMaxStructurePalette = 65536;
constexpr std::size_t kMaxStructureDataBytes = 4u << 20;  // total of all blocks
// Before compression: 500,000 cells of 2 bytes, a palette of 65,536 × 258 bytes and the data are 22 MB.
constexpr std::size_t kMaxStructureBytes = 32u << 20;

// Fails if the structure is invalid or exceeds the limits. Equal structures have equal bytes (with one
// version of zstd).
[[nodiscard]] base::Result<Bytes> encodeStructure(const world::Structure& structure);
// Decodes any bytes. The error for an invalid structure gives the reason. `maxBytes`: before compression;
// nothing larger is unpacked.
[[nodiscard]] base::Result<world::Structure> decodeStructure(ByteView bytes,
                                                             std::size_t maxBytes = kMaxStructureBytes);

// A name has 1 to 100 bytes, no slashes or control characters, and no leading dot or space. A name that no
// file has follows the rule of base/names.h, too.
[[nodiscard]] base::Result<std::filesystem::path> structurePath(const std::filesystem::path& folder,
                                                                std::string_view name);
// Creates the folder if needed. Errors name the file.
[[nodiscard]] base::Result<void> writeStructure(const std::filesystem::path& file,
                                                const world::Structure& structure);
[[nodiscard]] base::Result<world::Structure> readStructure(const std::filesystem::path& file);
// Returns the names of the structures in the folder, sorted; empty if there is no folder.
std::vector<std::string> structureNames(const std::filesystem::path& folder);

}  // namespace terrane::store
