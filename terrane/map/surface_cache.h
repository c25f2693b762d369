// A cache of generated surfaces on the disk: a file that never grows beyond a number of bytes and may be
// deleted at any time. It never holds edits, so it is valid as long as the generator is the same. Any thread
// may use it; concurrent calls wait for each other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/map/surface.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/world/coords.h"

namespace terrane::map {

// Compresses 256×256 columns of surface for a cache on the disk: 0.1 to 0.8 bytes a column at level 0, up to
// 1.5 at level 4 and 2 at level 8. Block ids are those of the registry, which the bytes do not name. Any
// thread may use it.
constexpr int kBlobColumns = 256;  // along each side
constexpr std::size_t kColumnsOfBlob = std::size_t{kBlobColumns} * kBlobColumns;
constexpr std::size_t kColumnPlanes = 8;  // bytes of a column before they are compressed

// Encodes kColumnsOfBlob columns, x + 256 y.
store::Bytes encodeSurfaces(std::span<const SurfaceColumn> columns);
// Decodes any bytes; returns Damaged if they are not such columns.
[[nodiscard]] base::Result<std::vector<SurfaceColumn>> decodeSurfaces(store::ByteView bytes);

// 256×256 columns of a level: those from 256 x, 256 y on.
struct BlobPos {
    std::int32_t x = 0, y = 0;
    std::uint8_t level = 0;

    auto operator<=>(const BlobPos&) const = default;
};

class SurfaceCache {
  public:
    // Opens the cache. `origin` identifies the inputs of the surfaces: seed, generator, its version, the
    // block ids. A file is replaced by an empty one if it has another origin, is damaged, comes from a newer
    // program or is larger than `maxBytes`. Fails if the file cannot be written, or if another program has it
    // open.
    [[nodiscard]] static base::Result<std::unique_ptr<SurfaceCache>> open(const std::filesystem::path& file,
                                                                          const std::string& origin,
                                                                          std::int64_t maxBytes);
    ~SurfaceCache();

    bool contains(BlobPos pos) const;
    // Returns the columns of an entry, or nothing if it is missing or damaged; a damaged entry is removed.
    std::optional<std::vector<SurfaceColumn>> find(BlobPos pos);
    // Removes the least recently used entries if the file would grow too large. A failure to write is logged
    // once.
    void put(BlobPos pos, std::span<const SurfaceColumn> columns);

    // Returns whether writing failed; put() then does nothing.
    bool isBroken() const;
    std::int64_t bytes() const;  // in the file, for all entries

  private:
    struct Impl;
    explicit SurfaceCache(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::map
