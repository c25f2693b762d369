#include "terrane/gen/generators/catalogue.h"

#include <fmt/ranges.h>

#include "terrane/base/nearest_name.h"

namespace terrane::gen {
namespace {

struct Entry {
    std::string_view name;
    int version;  // one more with every change that changes a block; catalogue_test.cpp tells
    void (*write)(GeneratorBuilder&);
};

constexpr Entry kGenerators[] = {{"overworld", 2, writeOverworld},
                                 {"continents", 1, writeContinents},
                                 {"flat", 1, writeFlat},
                                 {"hills3d", 1, writeHills3D},
                                 {"voronoi", 1, writeVoronoi}};

}  // namespace

std::vector<std::string> generatorNames() {
    std::vector<std::string> names;
    for (const Entry& entry : kGenerators) names.emplace_back(entry.name);
    return names;
}

int generatorVersion(std::string_view name) {
    for (const Entry& entry : kGenerators)
        if (entry.name == name) return entry.version;
    return 0;
}

base::Result<GeneratorGraph> makeGenerator(std::string_view name, const world::BlockRegistry& blocks,
                                           int level) {
    for (const Entry& entry : kGenerators) {
        if (entry.name != name) continue;
        GeneratorBuilder builder(std::string(name), blocks, level);
        entry.write(builder);
        return builder.finish();
    }
    const std::vector<std::string> names = generatorNames();
    return base::fail("unknown generator \"{}\": known are {}{}", name, fmt::join(names, ", "),
                      base::didYouMean(name, names));
}

base::Result<LevelGenerators> makeLevelGenerators(std::string_view name, const world::BlockRegistry& blocks,
                                                  std::uint64_t seed) {
    LevelGenerators made(
        [name = std::string(name), &blocks](int level) { return makeGenerator(name, blocks, level); }, seed);
    if (auto first = made.at(0); !first) return tl::unexpected(first.error());
    return made;
}

}  // namespace terrane::gen
