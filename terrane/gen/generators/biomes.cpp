#include "terrane/gen/generators/biomes.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

namespace {

base::Result<GeneratorGraph> columnPasses(const std::string& generator, const world::BlockRegistry& blocks,
                                          int level) {
    auto graph = makeGenerator(generator, blocks, level);
    if (graph) std::erase_if(graph->passes, [](const PassGraph& pass) { return pass.is3D; });
    return graph;
}

}  // namespace

std::optional<Biomes> Biomes::create(std::string_view generator, const world::BlockRegistry& blocks,
                                     std::uint64_t seed) {
    const auto names = biomesOf(generator);
    if (names.empty()) return std::nullopt;
    const std::string name(generator);
    const auto graph = columnPasses(name, blocks, 0);
    if (!graph) return std::nullopt;
    const auto field = std::ranges::find(graph->fields, "biome", &FieldInfo::name);
    if (field == graph->fields.end()) return std::nullopt;
    const auto number = static_cast<std::uint32_t>(field - graph->fields.begin());
    const auto make = [name, &blocks](int level) { return columnPasses(name, blocks, level); };
    return Biomes(LevelGenerators(make, seed, graph->heights), number, names);
}

std::array<std::uint8_t, 256> Biomes::of(world::ChunkPos chunk) const {
    const auto generator = generators_.at(chunk.level);
    if (!generator) throw std::invalid_argument(generator.error().message);
    const auto columns = (*generator)->columns(chunk, field_);
    std::array<std::uint8_t, 256> numbers;
    const auto last = static_cast<Bits>(names_.size() - 1);
    std::ranges::transform(columns, numbers.begin(),
                           [last](Bits biome) { return static_cast<std::uint8_t>(std::min(biome, last)); });
    return numbers;
}

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
    return biomes_.names()[numbers_[static_cast<std::size_t>((x & 15) + 16 * (y & 15))]];
}

}  // namespace terrane::gen
