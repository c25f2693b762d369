// The tint of a generator (GeneratorBuilder::tint) as a graph of its own: chunks do not compute it, and it
// needs no chunks. Any thread.
#pragma once

#include <string>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

struct TintGraph {
    GeneratorGraph passes;    // 2D passes alone, of the same level
    std::uint32_t field = 0;  // what they make: packed colors (world/tint.h)
};

// Sets generator.tint for a field of type Int, and removes from the generator what only the tint needs.
// Returns the reason if the field is no tint, else an empty string.
std::string cutTint(GeneratorGraph& generator, std::uint32_t field);

}  // namespace terrane::gen
