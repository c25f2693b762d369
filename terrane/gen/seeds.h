// Seeds of a generator's noise calls and hashes for one world seed. Both back ends take them from here.
// Any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

struct Seeds {
    std::vector<std::uint32_t> noises, hashes;  // by noise call, by slot of hashNames
};

std::uint32_t seedOf(const std::string& name, std::uint64_t worldSeed);

// A seed depends on the world's seed and on the name of its call, not on its place in the generator.
Seeds makeSeeds(const GeneratorGraph& generator, std::uint64_t worldSeed);
Seeds makeSeeds(const std::vector<NoiseCall>& noises, const std::vector<std::string>& hashNames,
                std::uint64_t worldSeed);

}  // namespace terrane::gen
