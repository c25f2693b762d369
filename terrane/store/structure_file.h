// A structure (world/structure.h) as a file of its own, NAME.structure. docs/structure-format.md describes
// the bytes. Plain functions; any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/bytes.h"
#include "terrane/world/structure.h"

namespace terrane::store {

constexpr std::uint8_t kStructureVersion = 1;

constexpr std::size_t kMaxStructurePalette = 65536;
constexpr std::size_t kMaxStructureDataBytes = 4u << 20;  // of all blocks that have some
// Before compression: 500,000 cells of 2 bytes, a palette of 65,536 × 258 bytes and the data are 22 MB.
constexpr std::size_t kMaxStructureBytes = 32u << 20;

// An error where the structure is none, or has more than a file keeps. Equal structures give equal bytes
// (with one version of zstd).
[[nodiscard]] base::Result<Bytes> encodeStructure(const world::Structure& structure);
// Any bytes may be given: what is no structure is an error that says why.
[[nodiscard]] base::Result<world::Structure> decodeStructure(ByteView bytes);

// A name has 1 to 100 bytes, neither slashes nor control characters, and no dot or space in front.
[[nodiscard]] base::Result<std::filesystem::path> structurePath(const std::filesystem::path& folder,
                                                                std::string_view name);
// Makes the folder where needed. Errors name the file.
[[nodiscard]] base::Result<void> writeStructure(const std::filesystem::path& file,
                                                const world::Structure& structure);
[[nodiscard]] base::Result<world::Structure> readStructure(const std::filesystem::path& file);
// Names of the structures in the folder, in alphabetical order; none where there is no folder.
std::vector<std::string> structureNames(const std::filesystem::path& folder);

}  // namespace terrane::store
