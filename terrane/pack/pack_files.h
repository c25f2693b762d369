// Packs on the disk: folders and zip files. Any thread may use it.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrane/pack/pack.h"
#include "terrane/store/chunks/bytes.h"

namespace terrane::pack {

// Reads the files of a pack from a zip file: those that isPackPath() accepts, at the top or in the folder of
// pack.toml. kMaxFiles and kMaxPackBytes limit the result, whatever the file claims. Errors name the file.
[[nodiscard]] base::Result<PackFiles> readZip(const std::filesystem::path& path);

// Does the same for bytes in memory; errors begin with `where`.
[[nodiscard]] base::Result<PackFiles> readZipBytes(std::string_view bytes, const std::string& where);

// Reads a folder with pack.toml in it, or a zip file with pack.toml at its top or in a folder at its top.
// Errors name the file.
[[nodiscard]] base::Result<Pack> readPack(const std::filesystem::path& path);

// Finds the folder or zip file of a pack by its path (with a slash, or ending in ".zip"), or by its name, as
// NAME or NAME.zip in `folders`. NotFound names the folders that were searched.
[[nodiscard]] base::Result<std::filesystem::path> findPack(std::string_view nameOrPath,
                                                           std::span<const std::filesystem::path> folders);

// Returns the packs of a folder, sorted: zip files, and folders with pack.toml. None is opened. The result is
// empty if there is no folder. It reads 1,000 entries at most.
std::vector<std::filesystem::path> packsIn(const std::filesystem::path& folder);

// A pack as an archive, which servers send and clients store, and its hash. docs/protocol.md ("Packs")
// specifies the format. Any thread may use it. SHA-256 of the files' paths and contents in order. Equal packs
// have equal hashes, whether folder, zip file or archive.
using PackHash = std::array<std::byte, 32>;
PackHash hashOf(const Pack& pack);
std::string hexOf(const PackHash& hash);  // 64 digits

// Returns the compressed archive. The same pack gives the same bytes, with one version of zstd.
store::Bytes archiveOf(const Pack& pack);

// Decodes any bytes. Returns an error if they are no archive or the pack exceeds the limits of pack.h.
[[nodiscard]] base::Result<Pack> packOf(store::ByteView archive, const std::string& where);

}  // namespace terrane::pack
