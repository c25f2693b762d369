// A hash of a recorded generator: two programs with equal hashes generate the same blocks. Any thread.
#pragma once

#include <cstdint>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

// Hashes everything that blocks depend on: outputs of passes and the nodes that compute them, noises and
// names of hashes, drainage maps, shapes, fields. Ignores names of passes, unused nodes and the tint. The
// order in which a pass is recorded does not count: compilers choose different ones.
[[nodiscard]] std::uint64_t graphHash(const GeneratorGraph& generator);

}  // namespace terrane::gen
