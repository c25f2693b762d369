// The biome of a place, for generators that have them: from the 2D passes alone. Used on one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "terrane/gen/generator.h"
#include "terrane/world/block_registry.h"

namespace terrane::gen {

class BiomeMap {
  public:
    // None where the built-in generator of this name has no biomes.
    static std::optional<BiomeMap> create(std::string_view generator, const world::BlockRegistry& blocks,
                                          std::uint64_t seed);

    // Of a column, in words: "birch forest". Remembers the last chunk; another takes some milliseconds.
    std::string_view at(std::int32_t x, std::int32_t y);

  private:
    BiomeMap(std::unique_ptr<Generator> generator, std::uint32_t field)
        : generator_(std::move(generator)), field_(field) {}

    std::unique_ptr<Generator> generator_;
    std::uint32_t field_;  // of the graph
    std::optional<world::ChunkPos> chunk_;
    std::array<Bits, 256> biomes_{};  // of that chunk's columns, x + 16 y
};

}  // namespace terrane::gen
