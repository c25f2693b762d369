// Compares the world of a store with the world that a program requests. All are plain values and functions;
// any thread may use them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/chunks/block_id_map.h"
#include "terrane/world/heights.h"

namespace terrane::store {

// The inputs that determine a world's generated chunks. They never change during the life of a save, except
// the version, when the world is regenerated.
struct WorldIdentity {
    std::uint64_t seed = 0;
    std::string generator;
    int generatorVersion = 0;
    world::Heights heights = {};

    bool operator==(const WorldIdentity&) const = default;
};

// A seed as a player writes it.
struct WrittenSeed {
    std::uint64_t seed = 0;
    std::string text;  // the text whose base::hash64 is the seed; empty for a number
};

// A number from 0 to 2^64 − 1; a negative one from −2^63, as other programs show the same 64 bits; or any
// other text. Fails for an empty text, and for a whole number out of range: hashed as a text it would give a
// world that the number does not identify. Pure; any thread.
[[nodiscard]] base::Result<WrittenSeed> seedFrom(std::string_view text);

// Chunks to regenerate with the program's version of the generator.
enum class Regenerate : std::uint8_t {
    None,
    AllButEdited,  // edited chunks stay; the terrain may have steps at their borders
    All,           // edits are lost
};

// The world that a player requests. Fields without a value are taken from the existing world.
struct RequestedWorld {
    std::optional<std::uint64_t> seed;
    std::optional<std::string> generator;
    world::RequestedHeights heights = {};
    Regenerate regenerate = Regenerate::None;
    // For the development of generators: if the generator's version differs, chunks without edits are
    // regenerated, and no backup is made.
    bool followsGenerator = false;
};

// Decision on an existing world: chunks to regenerate and the generator version to continue with.
struct Regeneration {
    Regenerate chunks = Regenerate::None;
    int generatorVersion = 0;
    bool keepsBackup = true;
};

// The program's version of a generator; 0 if it lacks the generator.
using GeneratorVersionOf = std::function<int(std::string_view generator)>;

// Options for opening a world for writing.
struct SaveAccess {
    // Creates the world with this identity if it does not exist. No value: it must exist.
    std::optional<WorldIdentity> create;
    // For a new world: ids and names of another world whose rows it will get.
    std::vector<SavedName> blockNames = {};
    // Selects the chunks to regenerate by the identity of an existing save, after a backup beside it. On an
    // error the world is not opened. Empty: nothing is regenerated.
    std::function<base::Result<Regeneration>(const WorldIdentity& saved)> decide;
};

// Fails with one line that names `where` and the difference, unless both are equal: chunks of two generators
// do not fit together.
[[nodiscard]] base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& requested,
                                             const std::string& where);

// Checks a saved world against the requested one, and selects the chunks to regenerate. Fails if it is
// another world, if the program lacks its generator, or if the versions differ and the world is not to be
// regenerated.
[[nodiscard]] base::Result<Regeneration> compareWorld(const WorldIdentity& saved,
                                                      const RequestedWorld& requested,
                                                      const GeneratorVersionOf& versionOf,
                                                      const std::string& where);

// Limits of a save: bytes of a name (settings and blocks), number of settings, bytes of all setting names and
// values.
constexpr std::size_t kMaxNameBytes = 1024, kMaxMetadata = 4096, kMaxMetadataBytes = std::size_t{16} << 20;

using Metadata = std::map<std::string, std::string, std::less<>>;

// Returns whether only stores write it: the world's identity, when a world is created or regenerated,
// kDerivedRowsMark and kChecksum.
bool isReserved(std::string_view name);

// Returns whether the metadata, with this value, fits the limits. The store's own rows count.
bool fitsMetadata(const Metadata& metadata, std::string_view name, std::string_view value);

// Returns the metadata of a new world.
Metadata metadataOf(const WorldIdentity& identity);

// Parses the identity. Fails, naming `where`, if an entry is missing or not a number, or the heights are not
// those of a world.
[[nodiscard]] base::Result<WorldIdentity> identityFrom(const Metadata& metadata, const std::string& where);

// Fails, naming `where`, unless the world has the format that its heights require. Programs that know only
// 0…255 read the lower format, and refuse the higher one.
[[nodiscard]] base::Result<void> requireFormat(std::int64_t format, std::int64_t required,
                                               const WorldIdentity& identity, const std::string& where);

}  // namespace terrane::store
