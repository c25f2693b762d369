// Values of options that several commands share; options.h parses them. Free of CLI11, which is slow to
// compile.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/world_identity.h"
#include "terrane/world/coords.h"

namespace CLI {
class App;
}

namespace terrane::app {

struct WorldOptions {
    // Defaults of a new world; an existing world keeps its own.
    static constexpr std::uint64_t kDefaultSeed = 1;
    static constexpr const char* kDefaultGenerator = "continents";

    std::optional<std::uint64_t> seed;
    std::string seedText;  // text that was hashed to the seed; empty for a number
    std::optional<std::string> generator;
    std::string otherwise = kDefaultGenerator;  // of the scene, for commands that draw one
    std::vector<std::string> content;           // packs: names or paths
    unsigned threads = 0;                       // 0: as many as the machine has

    std::uint64_t effectiveSeed() const { return seed.value_or(kDefaultSeed); }
    std::string effectiveGenerator() const { return generator.value_or(otherwise); }
};

// --world, --recreate, --regenerate, --store-generated.
struct SaveOptions {
    std::string world;  // a store::WorldLocation; empty: none, edits are lost at exit
    store::Regenerate regenerate = store::Regenerate::None;
    bool followsGenerator = false;  // store::RequestedWorld
    // Whether generated chunks are stored too. The world remembers it; by default they are.
    std::optional<bool> storeGenerated;
};

unsigned threadCount(const WorldOptions& options);

// The values of an option by name.
template <class T>
using EnumNames = std::span<const std::pair<std::string, T>>;

}  // namespace terrane::app
