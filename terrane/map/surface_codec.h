// Compresses 256×256 columns of surface for a cache on the disk: 0.1 to 0.8 bytes a column at level 0, up to
// 1.5 at level 4 and 2 at level 8. Block ids are those of the registry, which the bytes do not name
// (surface_cache.h). Any thread.
#pragma once

#include "terrane/base/result.h"
#include "terrane/map/surface.h"
#include "terrane/store/bytes.h"

namespace terrane::map {

constexpr int kBlobColumns = 256;  // along each side
constexpr std::size_t kColumnsOfBlob = std::size_t{kBlobColumns} * kBlobColumns;

// `columns`: kColumnsOfBlob, x + 256 y.
store::Bytes encodeSurfaces(std::span<const SurfaceColumn> columns);
// Takes any bytes; Damaged if they are not such columns.
[[nodiscard]] base::Result<std::vector<SurfaceColumn>> decodeSurfaces(store::ByteView bytes);

}  // namespace terrane::map
