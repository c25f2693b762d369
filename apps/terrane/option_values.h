// What options that several commands share say; options.h reads them. Without the parser, which takes long to
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
    // Where none is given: those of the world that is opened, or these of a new one.
    static constexpr std::uint64_t kDefaultSeed = 1;
    static constexpr const char* kDefaultGenerator = "continents";

    std::optional<std::uint64_t> seed;
    std::string seedText;  // that the seed was made from; empty where a number was given
    std::optional<std::string> generator;
    std::string otherwise = kDefaultGenerator;  // a scene's, where a command draws one
    std::vector<std::string> content;           // packs: names or paths
    unsigned threads = 0;                       // 0: as many as the machine has

    std::uint64_t effectiveSeed() const { return seed.value_or(kDefaultSeed); }
    std::string effectiveGenerator() const { return generator.value_or(otherwise); }
};

// --world, --recreate, --regenerate, --store-generated.
struct SaveOptions {
    std::string world;  // a store::WorldLocation; empty: none, edits last until the program ends
    store::Regenerate regenerate = store::Regenerate::None;
    bool followsGenerator = false;  // store::WantedWorld
    // Whether generated chunks are stored too. The world keeps it; where nothing is said they are.
    std::optional<bool> storeGenerated;
};

unsigned threadCount(const WorldOptions& options);

// The values of an option by name.
template <class T>
using EnumNames = std::span<const std::pair<std::string, T>>;

}  // namespace terrane::app
