#include "terrane/gen/generators/catalogue.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "terrane/base/text.h"

namespace terrane::gen {
namespace {

CatalogueEntry builtIn(std::string name, int version, void (*write)(GeneratorBuilder&)) {
    const auto record = [name, write](const world::BlockRegistry& blocks, int level) {
        GeneratorBuilder builder(name, blocks, level);
        write(builder);
        return builder.finish();
    };
    return {name, version, record};
}

const CatalogueEntry* find(const GeneratorCatalogue& catalogue, std::string_view name) {
    const auto found = std::ranges::find(catalogue, name, &CatalogueEntry::name);
    return found == catalogue.end() ? nullptr : &*found;
}

}  // namespace

// Every change of a generated block increments the version; catalogue_test.cpp checks it.
const GeneratorCatalogue& builtInGenerators() {
    static const GeneratorCatalogue catalogue = {
        builtIn("overworld", 2, writeOverworld), builtIn("continents", 1, writeContinents),
        builtIn("flat", 1, writeFlat), builtIn("hills3d", 1, writeHills3D),
        builtIn("voronoi", 1, writeVoronoi)};
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

base::Result<GeneratorGraph> makeGenerator(std::string_view name, const world::BlockRegistry& blocks,
                                           int level, const GeneratorCatalogue& catalogue) {
    if (const CatalogueEntry* entry = find(catalogue, name)) return entry->record(blocks, level);
    const std::vector<std::string> names = namesOf(catalogue);
    return base::fail("unknown generator \"{}\": known are {}{}", name, fmt::join(names, ", "),
                      base::didYouMean(name, names));
}

base::Result<LevelGenerators> makeLevelGenerators(std::string_view name, const world::BlockRegistry& blocks,
                                                  std::uint64_t seed, const GeneratorCatalogue& catalogue) {
    const CatalogueEntry* entry = find(catalogue, name);
    if (!entry) return tl::unexpected(makeGenerator(name, blocks, 0, catalogue).error());
    LevelGenerators made([record = entry->record, &blocks](int level) { return record(blocks, level); },
                         seed);
    (void)TERRANE_TRY(made.at(0));
    return made;
}

}  // namespace terrane::gen
