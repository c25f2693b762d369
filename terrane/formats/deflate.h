// Reads and writes zlib and gzip data. Called by the readers and writers of this module. Plain functions; any
// thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::formats {

// Decompresses zlib or gzip, recognized by the first bytes; bytes after the end of the stream are ignored.
// Damaged if the stream is broken or cut off, OutOfResources if it holds more than `maxBytes`. Messages name
// no file.
[[nodiscard]] base::Result<std::string> inflate(std::string_view bytes, std::size_t maxBytes);

// Compresses to one gzip member without name and time, so that equal bytes give equal files (with one version
// of zlib).
[[nodiscard]] std::string gzip(std::string_view bytes);

}  // namespace terrane::formats
