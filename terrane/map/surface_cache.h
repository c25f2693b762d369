// Surfaces of generated land on the disk: a file that never grows beyond a number of bytes and may be deleted
// at any time. It holds what the generator made, never what players built, so that it is right as long as the
// generator is the same. Any thread, any number at a time: one waits for the other.
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
    // `origin` tells what the surfaces follow from: seed, generator, its version, the block ids. A file of
    // another origin, a damaged one, one of a newer program, or one larger than `maxBytes` is begun anew.
    // Fails where the file cannot be written, or another program has it open.
    [[nodiscard]] static base::Result<std::unique_ptr<SurfaceCache>> open(const std::filesystem::path& file,
                                                                          const std::string& origin,
                                                                          std::int64_t maxBytes);
    ~SurfaceCache();

    bool contains(BlobPos pos) const;
    // Nothing where it is not there, or damaged: then it is forgotten.
    std::optional<std::vector<SurfaceColumn>> find(BlobPos pos);
    // Forgets what was not used for longest where the file would grow too large. What cannot be written is
    // logged once.
    void put(BlobPos pos, std::span<const SurfaceColumn> columns);

    // Something could not be written: put() does nothing any more.
    bool isBroken() const;
    std::int64_t bytes() const;  // of the file, for all that it holds

  private:
    struct Impl;
    explicit SurfaceCache(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::map
