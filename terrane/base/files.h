// Reads and writes whole files. Any thread may call. Errors name the path and the system's reason, for
// example "saves/a.npy: cannot be written: No such file or directory".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::base {

// Default limit for files that are read whole.
constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;

// Reads a regular file of at most `maxBytes`. Larger files, devices and pipes are refused before they are
// read.
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path,
                                           std::size_t maxBytes = kMaxFileBytes);

// Writes a file in one piece, as OutputFile does (output_file.h).
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::string_view bytes);

// Creates a file that only its owner may read, for keys. Fails if it exists; leaves no partial file. The
// bytes are on the disk when it returns.
[[nodiscard]] Result<void> writePrivateFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace terrane::base
