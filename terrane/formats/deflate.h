// Compressed bytes of files that other programs write: zlib and gzip. Called by the readers and writers of
// this module. Plain functions; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::formats {

// zlib or gzip, told apart by the first bytes; what follows the end of the stream is ignored. Damaged where
// the stream is broken or cut off, OutOfResources where it holds more than `maxBytes`. Messages name no file.
[[nodiscard]] base::Result<std::string> inflate(std::string_view bytes, std::size_t maxBytes);

// One gzip member without name and time, so that equal bytes give equal files (with one version of zlib).
[[nodiscard]] std::string gzip(std::string_view bytes);

}  // namespace terrane::formats
