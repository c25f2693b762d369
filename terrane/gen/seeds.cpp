#include "terrane/gen/seeds.h"

#include <xxhash.h>

#include <string>

namespace terrane::gen {

std::uint32_t seedOf(const std::string& name, std::uint64_t worldSeed) {
    return static_cast<std::uint32_t>(XXH3_64bits_withSeed(name.data(), name.size(), worldSeed));
}

Seeds makeSeeds(const GeneratorGraph& generator, std::uint64_t worldSeed) {
    return makeSeeds(generator.noises, generator.hashNames, worldSeed);
}

Seeds makeSeeds(const std::vector<NoiseCall>& noises, const std::vector<std::string>& hashNames,
                std::uint64_t worldSeed) {
    Seeds seeds;
    for (const NoiseCall& call : noises) seeds.noises.push_back(seedOf(noiseSeedName(call.name), worldSeed));
    for (const std::string& name : hashNames) seeds.hashes.push_back(seedOf(name, worldSeed));
    return seeds;
}

}  // namespace terrane::gen
