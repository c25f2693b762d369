// Finds block types and generators and opens worlds for Python. Any thread, without Python's lock.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/pack/content.h"
#include "terrane/volume/opened_world.h"

namespace terrane::python {

constexpr unsigned kMaxThreads = 256;

// A generated world; the values are the defaults.
struct NewWorld {
    std::uint64_t seed = 1;
    std::string generator = gen::kDefaultGenerator;
    std::vector<std::string> content;      // packs: names or paths
    world::RequestedHeights heights = {};  // else the generator's
};

// An existing world, or a new one.
struct SavedWorld {
    std::string location;  // a name, a file or a URL (store/world_location.h)
    bool isReadOnly = false;
    bool isCreated = false;  // if it does not exist
    // Required values of an existing world, or values for a new one.
    std::optional<std::uint64_t> seed;
    std::optional<std::string> generator;
    std::vector<std::string> content;  // packs besides those that it remembers
    world::RequestedHeights heights = {};
};

// The parts of a world, and their content.
struct WorldSources {
    pack::Content content;
    volume::WorldParts parts;
};

// The names of built-in generators and of those of packs.
[[nodiscard]] base::Result<std::vector<std::string>> generatorNames(const std::vector<std::string>& content);

// The generators of a world at all levels. The content's block types outlive them.
[[nodiscard]] base::Result<gen::LevelGenerators> generatorsOf(const store::WorldIdentity& identity,
                                                              const pack::Content& content);

// The machine's thread count for 0, at most kMaxThreads.
unsigned threadCountOf(unsigned threads);

// A generated world in memory: edits last as long as the object.
[[nodiscard]] base::Result<WorldSources> generatedWorld(const NewWorld& world, unsigned threads);

// Opens a saved world. Fails as store_postgres::openAnyWorld().
[[nodiscard]] base::Result<WorldSources> savedWorld(const SavedWorld& world, unsigned threads);

}  // namespace terrane::python
