// The biome of a place, for generators that have them. Used on one thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "terrane/gen/generators/biomes.h"

namespace terrane::gen {

class BiomeMap {
  public:
    // As Biomes::create().
    static std::optional<BiomeMap> create(std::string_view generator, const world::BlockRegistry& blocks,
                                          std::uint64_t seed);

    // The name of a column's biome: "birch forest". Keeps the biomes of the last chunk; for another chunk it
    // calls Biomes::of().
    std::string_view at(std::int32_t x, std::int32_t y);

  private:
    explicit BiomeMap(Biomes biomes) : biomes_(std::move(biomes)) {}

    Biomes biomes_;
    std::optional<world::ChunkPos> chunk_;
    std::array<std::uint8_t, 256> numbers_{};  // of that chunk's columns
};

}  // namespace terrane::gen
