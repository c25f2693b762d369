// Generators by name: those that come with Terrane, and those that a program adds, such as scripts of packs.
// Any thread; each call has a builder of its own.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/language/builder.h"
#include "terrane/gen/level_generators.h"
#include "terrane/world/sky/air.h"

namespace terrane::gen {

// z of the highest water of the sea, of all generators whose entry does not say otherwise. Height 0 of maps.
constexpr int kSeaLevel = 80;
// Blocks from the sea up to the clouds, likewise.
constexpr int kCloudRise = 280;

struct CatalogueEntry {
    std::string name;
    // At least 1. The same name and version make the same blocks; saves store both.
    int version = 1;
    std::function<base::Result<GeneratorGraph>(const world::BlockRegistry& blocks, GraphRequest request)>
        record;
    int seaLevel = kSeaLevel;
    int cloudRise = kCloudRise;
    // Names of its biomes, by the numbers in its field "biome"; empty if it has none. At most 256.
    std::vector<std::string_view> biomes = {};
};

// Names are unique. It is a plain value.
using GeneratorCatalogue = std::vector<CatalogueEntry>;

const GeneratorCatalogue& builtInGenerators();

constexpr const char* kDefaultGenerator = "wilderness";  // of new worlds

std::vector<std::string> namesOf(const GeneratorCatalogue& catalogue);

// Returns the version of a generator; 0 for an unknown name.
int versionOf(const GeneratorCatalogue& catalogue, std::string_view name);

// Returns the sea level of a world of this generator; kSeaLevel for an unknown name.
int seaLevelOf(std::string_view name, const GeneratorCatalogue& catalogue = builtInGenerators());

// Returns the levels of the air over a world of this generator, likewise.
world::AirLevels airLevelsOf(std::string_view name,
                             const GeneratorCatalogue& catalogue = builtInGenerators());

// Returns the names of a generator's biomes; empty if it has none. They are valid as long as the catalogue.
std::span<const std::string_view> biomesOf(std::string_view name,
                                           const GeneratorCatalogue& catalogue = builtInGenerators());

// Returns a graph. An unknown name is an error that lists the known ones.
[[nodiscard]] base::Result<GeneratorGraph> makeGenerator(
    std::string_view name, const world::BlockRegistry& blocks, GraphRequest request,
    const GeneratorCatalogue& catalogue = builtInGenerators());
[[nodiscard]] inline base::Result<GeneratorGraph> makeGenerator(
    std::string_view name, const world::BlockRegistry& blocks, int level = 0,
    const GeneratorCatalogue& catalogue = builtInGenerators()) {
    return makeGenerator(name, blocks, GraphRequest{level, {}}, catalogue);
}

// Returns the heights of a new world: those that are requested, else those that the generator declares. Fails
// if there is no such generator, or if they are not those of a world.
[[nodiscard]] base::Result<world::Heights> heightsOf(std::string_view name,
                                                     const world::BlockRegistry& blocks,
                                                     world::RequestedHeights requested,
                                                     const GeneratorCatalogue& catalogue);

// Makes the generators of all levels of a world, whose heights are those of heightsOf(). The block types
// outlive the result.
[[nodiscard]] base::Result<LevelGenerators> makeLevelGenerators(
    std::string_view name, const world::BlockRegistry& blocks, std::uint64_t seed,
    const GeneratorCatalogue& catalogue = builtInGenerators(), world::RequestedHeights heights = {});

void writeOverworld(
    GeneratorBuilder& g);  // overworld.cpp: seas, rivers, plains, deserts, mountains, caves, plants
void writeContinents(GeneratorBuilder& g);  // continents.cpp: see docs/continents.md
void writeWilderness(GeneratorBuilder& g);  // wilderness.cpp: see docs/wilderness.md
void writeFlat(GeneratorBuilder& g);        // grass at sea level
void writeHills3D(GeneratorBuilder& g);     // overhangs and arches from noise in space
void writeVoronoi(GeneratorBuilder& g);     // bowls and ridges, boxy chambers

}  // namespace terrane::gen
