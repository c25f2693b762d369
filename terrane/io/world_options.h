// Plain settings that name a world and say how it is opened. Pure; any thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/world/heights.h"

namespace terrane::io {

struct WorldOptions {
    // Defaults of a new world; an existing world keeps its own.
    static constexpr std::uint64_t kDefaultSeed = 1;
    static constexpr const char* kDefaultGenerator = gen::kDefaultGenerator;

    std::optional<std::uint64_t> seed;
    std::string seedText;  // text that was hashed to the seed; empty for a number
    std::optional<std::string> generator;
    std::string otherwise = kDefaultGenerator;  // of the scene, for programs that draw one
    std::vector<std::string> content;           // packs: names or paths
    world::RequestedHeights heights = {};       // else the generator's; once a world is opened, its own
    unsigned threads = 0;                       // 0: as many as the machine has

    std::uint64_t effectiveSeed() const { return seed.value_or(kDefaultSeed); }
    std::string effectiveGenerator() const { return generator.value_or(otherwise); }
};

struct SaveOptions {
    std::string world;  // a store::WorldLocation; empty: none, edits are lost at exit
    store::Regenerate regenerate = store::Regenerate::None;
    bool followsGenerator = false;  // store::RequestedWorld
    // Whether generated chunks are stored too. The world remembers it; by default they are.
    std::optional<bool> storeGenerated;
};

inline unsigned threadCount(const WorldOptions& options) {
    return options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
}

// Called during a long run, on the caller's thread, with the part that is done. The run stops with an error
// if it returns false; an empty function never stops it.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

}  // namespace terrane::io
