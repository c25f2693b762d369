// Computes the biomes of chunks of any level, for generators that have biomes, from the 2D passes alone: they
// are the same in worlds of all heights. Any thread may use it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "terrane/gen/level_generators.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::gen {

class Biomes {
  public:
    // Creates the biomes of a built-in generator. Returns nothing if the generator of this name has no
    // biomes. `blocks` outlives it.
    static std::optional<Biomes> create(std::string_view generator, const world::BlockRegistry& blocks,
                                        std::uint64_t seed);

    // Returns the names of the generator's biomes by number: "birch forest".
    std::span<const std::string_view> names() const { return names_; }

    // Returns the numbers of the biomes of a chunk's columns, x + 16 y. Takes about 0.1 ms, and the first
    // time of a level some milliseconds. Throws std::invalid_argument for a position outside the world.
    std::array<std::uint8_t, 256> of(world::ChunkPos chunk) const;

  private:
    Biomes(LevelGenerators generators, std::uint32_t field, std::span<const std::string_view> names)
        : generators_(std::move(generators)), field_(field), names_(names) {}

    LevelGenerators generators_;               // of the 2D passes
    std::uint32_t field_;                      // of their graphs
    std::span<const std::string_view> names_;  // of the catalogue
};

// Returns the biome of a column, for generators that have biomes. It is used on one thread.
class BiomeMap {
  public:
    // Creates a map as Biomes::create() does.
    static std::optional<BiomeMap> create(std::string_view generator, const world::BlockRegistry& blocks,
                                          std::uint64_t seed);

    // Returns the name of a column's biome: "birch forest". Caches the biomes of the last chunk; for another
    // chunk it calls Biomes::of().
    std::string_view at(std::int32_t x, std::int32_t y);

  private:
    explicit BiomeMap(Biomes biomes) : biomes_(std::move(biomes)) {}

    Biomes biomes_;
    std::optional<world::ChunkPos> chunk_;
    std::array<std::uint8_t, 256> numbers_{};  // of that chunk's columns
};

}  // namespace terrane::gen
