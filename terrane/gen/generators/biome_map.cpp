#include "terrane/gen/generators/biome_map.h"

#include "terrane/world/coords.h"

namespace terrane::gen {

std::optional<BiomeMap> BiomeMap::create(std::string_view generator, const world::BlockRegistry& blocks,
                                         std::uint64_t seed) {
    auto biomes = Biomes::create(generator, blocks, seed);
    if (!biomes) return std::nullopt;
    return BiomeMap(std::move(*biomes));
}

std::string_view BiomeMap::at(std::int32_t x, std::int32_t y) {
    const world::ChunkPos chunk = world::chunkOf({x, y, 0});
    if (chunk_ != chunk) {
        numbers_ = biomes_.of(chunk);
        chunk_ = chunk;
    }
    return Biomes::names()[numbers_[static_cast<std::size_t>((x & 15) + 16 * (y & 15))]];
}

}  // namespace terrane::gen
