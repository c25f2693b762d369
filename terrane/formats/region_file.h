// Region files of Minecraft (.mca, "Anvil"): 32×32 chunks, each compressed separately in sectors of 4,096
// bytes. `terrane import` calls it. The functions have no state; any thread may call them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::formats {

constexpr int kRegionSide = 32;  // chunks
constexpr int kRegionChunks = kRegionSide * kRegionSide;
// Larger files are refused: 1,024 chunks of 255 sectors are 1 GiB; usual files have 5 to 20 MiB.
constexpr std::size_t kMaxRegionBytes = std::size_t{1} << 30;
// The limit for a decompressed chunk; usual chunks have 0.1 to 1 MiB.
constexpr std::size_t kMaxChunkBytes = std::size_t{32} << 20;

struct RegionPos {
    std::int32_t x = 0, z = 0;  // in regions; Minecraft's axes
    auto operator<=>(const RegionPos&) const = default;
};

// Returns the position in a name "r.X.Z.mca"; nothing for other names.
[[nodiscard]] std::optional<RegionPos> regionPosOf(std::string_view fileName);

// Returns the bytes of a chunk that is stored in its own file, c.X.Z.mcc beside the region, X and Z in
// chunks.
using ExternalChunk = std::function<base::Result<std::string>()>;

// Returns whether the file has a chunk number x + 32 z, counted in the region. Returns false if the file is
// too short.
[[nodiscard]] bool regionHasChunk(std::string_view region, int number);

// The chunk's NBT, decompressed from gzip, zlib or LZ4. NotFound if there is none, Unsupported for other
// compressions, Damaged if it lies outside the file or is broken. Messages name no file.
[[nodiscard]] base::Result<std::string> readRegionChunk(std::string_view region, int number,
                                                        const ExternalChunk& external);

}  // namespace terrane::formats
