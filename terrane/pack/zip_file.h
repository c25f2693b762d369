// Reads the files of a pack from a zip file. Any thread.
#pragma once

#include <filesystem>

#include "terrane/pack/pack.h"

namespace terrane::pack {

// The files that isPackPath() accepts, at the top or in the folder of pack.toml. Bounded by kMaxFiles and
// kMaxPackBytes, whatever the file claims. Errors name the file.
[[nodiscard]] base::Result<PackFiles> readZip(const std::filesystem::path& path);

// The same for bytes in memory; errors begin with `where`.
[[nodiscard]] base::Result<PackFiles> readZipBytes(std::string_view bytes, const std::string& where);

}  // namespace terrane::pack
