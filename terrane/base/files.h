// Whole files in and out. Any thread may call. Errors name the path and the system's reason, for example
// "saves/a.npy: cannot be written: No such file or directory".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::base {

// No file that is read whole is larger, unless the caller says so.
constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;

// A regular file of at most `maxBytes`. Others are refused before they are read: a device, a pipe that nobody
// writes to, what is too large.
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path,
                                           std::size_t maxBytes = kMaxFileBytes);

// As OutputFile (output_file.h), in one piece.
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace terrane::base
