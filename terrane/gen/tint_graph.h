// The tint of a generator (GeneratorBuilder::tint): the passes that make it are cut out of the others, so
// that chunks cost nothing for it and it costs no chunk. Any thread.
#pragma once

#include <string>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

struct TintGraph {
    GeneratorGraph passes;    // 2D passes alone, of the same level
    std::uint32_t field = 0;  // what they make: packed colors (world/tint.h)
};

// Sets generator.tint for a field that is of type Int, and takes out of the generator's passes what only the
// tint needs. What is wrong with the field, or nothing.
std::string cutTint(GeneratorGraph& generator, std::uint32_t field);

}  // namespace terrane::gen
