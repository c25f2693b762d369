#include "terrane/gen/generators/catalogue.h"

#include <fmt/ranges.h>

#include <array>

namespace terrane::gen {
namespace {

struct Entry {
    std::string_view name;
    void (*write)(GeneratorBuilder&);
};

constexpr std::array<Entry, 4> kGenerators = {{{"overworld", writeOverworld},
                                               {"flat", writeFlat},
                                               {"hills3d", writeHills3D},
                                               {"voronoi", writeVoronoi}}};

}  // namespace

std::vector<std::string> generatorNames() {
    std::vector<std::string> names;
    for (const Entry& entry : kGenerators) names.emplace_back(entry.name);
    return names;
}

base::Result<GeneratorGraph> makeGenerator(std::string_view name, const world::BlockRegistry& blocks) {
    for (const Entry& entry : kGenerators) {
        if (entry.name != name) continue;
        GeneratorBuilder builder(std::string(name), blocks);
        entry.write(builder);
        return builder.finish();
    }
    return base::fail("unknown generator \"{}\": known are {}", name, fmt::join(generatorNames(), ", "));
}

}  // namespace terrane::gen
