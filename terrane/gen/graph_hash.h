// A number that tells two recorded generators apart: two programs whose numbers are equal generate the same
// blocks. Any thread.
#pragma once

#include <cstdint>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

// Of all that blocks follow from: what passes write and from which nodes, noises and names of hashes,
// drainage maps, shapes, fields. Not of names of passes, of what is recorded and not used, nor of the tint.
// The order in which a pass is recorded does not count: compilers choose different ones.
[[nodiscard]] std::uint64_t graphHash(const GeneratorGraph& generator);

}  // namespace terrane::gen
