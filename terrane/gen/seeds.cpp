#include "terrane/gen/seeds.h"

#include <xxhash.h>

#include <string>

namespace terrane::gen {
namespace {

std::uint32_t seedOf(const std::string& name, std::uint64_t worldSeed) {
    return static_cast<std::uint32_t>(XXH3_64bits_withSeed(name.data(), name.size(), worldSeed));
}

}  // namespace

Seeds makeSeeds(const GeneratorGraph& generator, std::uint64_t worldSeed) {
    Seeds seeds;
    for (const NoiseCall& call : generator.noises)
        seeds.noises.push_back(seedOf(noiseSeedName(call.name), worldSeed));
    for (const std::string& name : generator.hashNames) seeds.hashes.push_back(seedOf(name, worldSeed));
    return seeds;
}

}  // namespace terrane::gen
