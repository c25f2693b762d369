// The files of a pack in a zip file. Any thread.
#pragma once

#include <filesystem>

#include "terrane/pack/pack.h"

namespace terrane::pack {

// Those that isPackPath() takes, at the top or in the only folder there. Bounded by kMaxFiles and
// kMaxPackBytes, whatever the file claims. Errors name the file.
[[nodiscard]] base::Result<PackFiles> readZip(const std::filesystem::path& path);

// The same of bytes in memory; `where` stands in errors.
[[nodiscard]] base::Result<PackFiles> readZipBytes(std::string_view bytes, const std::string& where);

}  // namespace terrane::pack
