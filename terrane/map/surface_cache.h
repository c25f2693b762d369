// A cache of generated surfaces on the disk: a file that never grows beyond a number of bytes and may be
// deleted at any time. It never holds edits, so it is valid as long as the generator is the same. Any thread;
// calls wait for each other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/map/surface.h"
#include "terrane/world/coords.h"

namespace terrane::map {

// 256×256 columns of a level: those from 256 x, 256 y on.
struct BlobPos {
    std::int32_t x = 0, y = 0;
    std::uint8_t level = 0;

    auto operator<=>(const BlobPos&) const = default;
};

class SurfaceCache {
  public:
    // `origin` identifies the inputs of the surfaces: seed, generator, its version, the block ids. A file is
    // replaced by an empty one if it has another origin, is damaged, comes from a newer program or is larger
    // than `maxBytes`. Fails if the file cannot be written, or if another program has it open.
    [[nodiscard]] static base::Result<std::unique_ptr<SurfaceCache>> open(const std::filesystem::path& file,
                                                                          const std::string& origin,
                                                                          std::int64_t maxBytes);
    ~SurfaceCache();

    bool contains(BlobPos pos) const;
    // Nothing if the entry is missing or damaged; a damaged one is removed.
    std::optional<std::vector<SurfaceColumn>> find(BlobPos pos);
    // Removes the least recently used entries if the file would grow too large. A failure to write is logged
    // once.
    void put(BlobPos pos, std::span<const SurfaceColumn> columns);

    // Writing failed: put() does nothing any more.
    bool isBroken() const;
    std::int64_t bytes() const;  // in the file, for all entries

  private:
    struct Impl;
    explicit SurfaceCache(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::map
