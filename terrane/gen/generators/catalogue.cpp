#include "terrane/gen/generators/catalogue.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "terrane/base/text.h"
#include "terrane/gen/generators/continents.h"
#include "terrane/gen/generators/wilderness.h"

namespace terrane::gen {
namespace {

CatalogueEntry builtIn(std::string name, int version, void (*write)(GeneratorBuilder&)) {
    const auto record = [name, write](const world::BlockRegistry& blocks, GraphRequest request) {
        GeneratorBuilder builder(name, blocks, request);
        write(builder);
        return builder.finish();
    };
    return {name, version, record};
}

template <class Biome>
std::vector<std::string_view> biomeNames(const char* (*nameOf)(Biome)) {
    std::vector<std::string_view> names;
    for (int k = 0; k < static_cast<int>(Biome::Count); ++k)
        names.emplace_back(nameOf(static_cast<Biome>(k)));
    return names;
}

const CatalogueEntry* find(const GeneratorCatalogue& catalogue, std::string_view name) {
    const auto found = std::ranges::find(catalogue, name, &CatalogueEntry::name);
    return found == catalogue.end() ? nullptr : &*found;
}

}  // namespace

// Every change of a generated block increments the version; catalogue_test.cpp checks it.
const GeneratorCatalogue& builtInGenerators() {
    static const GeneratorCatalogue catalogue = [] {
        CatalogueEntry continents = builtIn("continents", 1, writeContinents),
                       wilderness = builtIn("wilderness", 1, writeWilderness);
        continents.biomes = biomeNames(continents::biomeName);
        wilderness.biomes = biomeNames(wilderness::biomeName);
        wilderness.seaLevel = wilderness::kSeaZ;
        wilderness.cloudRise = wilderness::kCloudZ - wilderness::kSeaZ;
        return GeneratorCatalogue{builtIn("overworld", 2, writeOverworld),
                                  continents,
                                  wilderness,
                                  builtIn("flat", 1, writeFlat),
                                  builtIn("hills3d", 1, writeHills3D),
                                  builtIn("voronoi", 1, writeVoronoi)};
    }();
    return catalogue;
}

std::vector<std::string> namesOf(const GeneratorCatalogue& catalogue) {
    std::vector<std::string> names;
    for (const CatalogueEntry& entry : catalogue) names.push_back(entry.name);
    return names;
}

int versionOf(const GeneratorCatalogue& catalogue, std::string_view name) {
    const CatalogueEntry* entry = find(catalogue, name);
    return entry ? entry->version : 0;
}

int seaLevelOf(std::string_view name, const GeneratorCatalogue& catalogue) {
    const CatalogueEntry* entry = find(catalogue, name);
    return entry ? entry->seaLevel : kSeaLevel;
}

world::AirLevels airLevelsOf(std::string_view name, const GeneratorCatalogue& catalogue) {
    const CatalogueEntry* entry = find(catalogue, name);
    const int sea = entry ? entry->seaLevel : kSeaLevel, rise = entry ? entry->cloudRise : kCloudRise;
    return {static_cast<float>(sea), static_cast<float>(sea + rise)};
}

std::span<const std::string_view> biomesOf(std::string_view name, const GeneratorCatalogue& catalogue) {
    const CatalogueEntry* entry = find(catalogue, name);
    return entry ? std::span<const std::string_view>(entry->biomes) : std::span<const std::string_view>();
}

namespace {

base::Result<const CatalogueEntry*> entryNamed(std::string_view name, const GeneratorCatalogue& catalogue) {
    if (const CatalogueEntry* entry = find(catalogue, name)) return entry;
    const std::vector<std::string> names = namesOf(catalogue);
    return base::fail(base::ErrorCode::BadInput, "unknown generator \"{}\": known are {}{}", name,
                      fmt::join(names, ", "), base::didYouMean(name, names));
}

}  // namespace

base::Result<GeneratorGraph> makeGenerator(std::string_view name, const world::BlockRegistry& blocks,
                                           GraphRequest request, const GeneratorCatalogue& catalogue) {
    const CatalogueEntry* entry = TERRANE_TRY(entryNamed(name, catalogue));
    return entry->record(blocks, request);
}

base::Result<world::Heights> heightsOf(std::string_view name, const world::BlockRegistry& blocks,
                                       world::RequestedHeights requested,
                                       const GeneratorCatalogue& catalogue) {
    const CatalogueEntry* entry = TERRANE_TRY(entryNamed(name, catalogue));
    world::Heights declared;
    if (!requested.bottom || !requested.top) declared = TERRANE_TRY(entry->record(blocks, {})).heights;
    const world::Heights heights = requested.over(declared);
    if (const auto valid = world::checkHeights(heights); !valid)
        return base::fail(base::ErrorCode::BadInput, "{}", valid.error().message);
    return heights;
}

base::Result<LevelGenerators> makeLevelGenerators(std::string_view name, const world::BlockRegistry& blocks,
                                                  std::uint64_t seed, const GeneratorCatalogue& catalogue,
                                                  world::RequestedHeights requested) {
    const CatalogueEntry* entry = TERRANE_TRY(entryNamed(name, catalogue));
    const auto heights = TERRANE_TRY(heightsOf(name, blocks, requested, catalogue));
    LevelGenerators made(
        [record = entry->record, &blocks, heights](int level) {
            return record(blocks, {level, heights});
        },
        seed, heights);
    (void)TERRANE_TRY(made.at(0));
    return made;
}

}  // namespace terrane::gen
