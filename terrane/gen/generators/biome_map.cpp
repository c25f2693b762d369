#include "terrane/gen/generators/biome_map.h"

#include <algorithm>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/continents.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

std::optional<BiomeMap> BiomeMap::create(std::string_view generator, const world::BlockRegistry& blocks,
                                         std::uint64_t seed) {
    if (generator != "continents") return std::nullopt;
    auto graph = makeGenerator(std::string(generator), blocks);
    if (!graph) return std::nullopt;
    std::erase_if(graph->passes, [](const PassGraph& pass) { return pass.is3D; });
    const auto field = std::ranges::find(graph->fields, "biome", &FieldInfo::name);
    if (field == graph->fields.end()) return std::nullopt;
    const auto number = static_cast<std::uint32_t>(field - graph->fields.begin());
    return BiomeMap(std::make_unique<Generator>(std::move(*graph), seed), number);
}

std::string_view BiomeMap::at(std::int32_t x, std::int32_t y) {
    const world::ChunkPos chunk = world::chunkOf({x, y, 0});
    if (chunk_ != chunk) {
        biomes_ = generator_->columns(chunk, field_);
        chunk_ = chunk;
    }
    const Bits biome = biomes_[static_cast<std::size_t>((x & 15) + 16 * (y & 15))];
    return continents::biomeName(
        static_cast<continents::Biome>(std::min(biome, static_cast<Bits>(continents::Biome::Count) - 1)));
}

}  // namespace terrane::gen
