// The generators that come with Terrane, by name. Any thread; each call has a builder of its own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/builder.h"
#include "terrane/gen/level_generators.h"

namespace terrane::gen {

std::vector<std::string> generatorNames();

// The same name and version make the same blocks: saves hold both. 0 for an unknown name.
int generatorVersion(std::string_view name);

// The graph of one level. An unknown name is an error that lists the known ones.
[[nodiscard]] base::Result<GeneratorGraph> makeGenerator(std::string_view name,
                                                         const world::BlockRegistry& blocks, int level = 0);

// The same for all levels of a world. The block types outlive it.
[[nodiscard]] base::Result<LevelGenerators> makeLevelGenerators(std::string_view name,
                                                                const world::BlockRegistry& blocks,
                                                                std::uint64_t seed);

void writeOverworld(
    GeneratorBuilder& g);  // overworld.cpp: seas, rivers, plains, deserts, mountains, caves, plants
void writeContinents(GeneratorBuilder& g);  // continents.cpp: see docs/continents.md
void writeFlat(GeneratorBuilder& g);        // flat.cpp: grass at sea level
void writeHills3D(GeneratorBuilder& g);     // hills3d.cpp: overhangs and arches from noise in space
void writeVoronoi(GeneratorBuilder& g);     // voronoi.cpp: bowls and ridges, boxy chambers

}  // namespace terrane::gen
