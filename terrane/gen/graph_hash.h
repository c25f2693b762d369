// A number that tells two recorded generators apart: two programs whose numbers are equal generate the same
// blocks. Any thread.
#pragma once

#include <cstdint>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

// Of all that blocks follow from: nodes, noises, names of hashes, drainage maps, shapes, fields. Not of names
// of passes, nor of the tint. Another number says little: another program may record the same in another
// order.
[[nodiscard]] std::uint64_t graphHash(const GeneratorGraph& generator);

}  // namespace terrane::gen
