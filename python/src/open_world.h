// Finds block types and generators and opens worlds for Python: the one place that knows where they come
// from. Any thread, without Python's lock.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/pack/content.h"
#include "terrane/volume/opened_world.h"

namespace terrane::python {

constexpr unsigned kMaxThreads = 256;

// Where a call says nothing.
struct NewWorld {
    std::uint64_t seed = 1;
    std::string generator = "continents";
    std::vector<std::string> content;  // packs: names or paths
};

// An existing world, or one to be created.
struct SavedWorld {
    std::string location;  // a name, a file or a URL (store/world_location.h)
    bool isReadOnly = false;
    bool isCreated = false;  // where it is not there
    // What it must be, or is created with.
    std::optional<std::uint64_t> seed;
    std::optional<std::string> generator;
    std::vector<std::string> content;  // packs beside those that it remembers
};

// A world's parts with the content that they are made from.
struct WorldSources {
    pack::Content content;
    volume::WorldParts parts;
};

// The built-in ones, and those of packs.
[[nodiscard]] base::Result<std::vector<std::string>> generatorNames(const std::vector<std::string>& content);

// The generator of a world, at all levels. The content's block types outlive it.
[[nodiscard]] base::Result<gen::LevelGenerators> generatorsOf(const store::WorldIdentity& identity,
                                                              const pack::Content& content);

// As many threads as the machine has for 0. BadInput beyond kMaxThreads.
[[nodiscard]] base::Result<unsigned> threadCountOf(int threads);

// A generated world whose edits last as long as it.
[[nodiscard]] base::Result<WorldSources> generatedWorld(const NewWorld& world, unsigned threads);

// Errors of store_postgres::openAnyWorld().
[[nodiscard]] base::Result<WorldSources> savedWorld(const SavedWorld& world, unsigned threads);

}  // namespace terrane::python
