// Which world a store holds, against the world that a program wants. Plain values and functions, for any
// thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/block_id_map.h"

namespace terrane::store {

// What a world's generated chunks follow from. It never changes during the life of a save, but for the
// version, when the world is regenerated.
struct WorldIdentity {
    std::uint64_t seed = 0;
    std::string generator;
    int generatorVersion = 0;

    bool operator==(const WorldIdentity&) const = default;
};

// Which chunks of a world are made anew by the program's version of its generator.
enum class Regenerate : std::uint8_t {
    None,
    AllButEdited,  // chunks with edits stay as they are: beside them the ground may have steps
    All,           // edits are lost
};

// What the player asks for. What is not given is taken from the world that is there.
struct WantedWorld {
    std::optional<std::uint64_t> seed;
    std::optional<std::string> generator;
    Regenerate regenerate = Regenerate::None;
    // Who works on a generator: where it has another version now, chunks without edits are made anew, and no
    // copy is kept.
    bool followsGenerator = false;
};

// What is to be done with a world that is taken: by which version of its generator it goes on.
struct Regeneration {
    Regenerate chunks = Regenerate::None;
    int generatorVersion = 0;
    bool keepsCopy = true;
};

// The version that the program has of a generator; 0: the program does not have it.
using GeneratorVersionOf = std::function<int(std::string_view generator)>;

// What is done with a world where it is opened to be written.
struct SaveAccess {
    // Made, where it is not there. Nothing: it must be there.
    std::optional<WorldIdentity> create;
    // Of a world that is made: the ids and names of another one, whose rows it will get.
    std::vector<SavedName> blockNames = {};
    // What of a save that is there is regenerated, after a copy beside it, from what it is; an error to
    // leave it alone. Empty: it is taken as it is.
    std::function<base::Result<Regeneration>(const WorldIdentity& saved)> decide;
};

// An error that says in one line how they differ and names `where`, unless they are equal: chunks of two
// generators do not fit together.
[[nodiscard]] base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& wanted,
                                             const std::string& where);

// Whether a saved world is the one that is wanted, and what is to be regenerated. An error where it is
// another world, or where the program lacks its generator, or has another version of it and the world is not
// to be regenerated.
[[nodiscard]] base::Result<Regeneration> compareWorld(const WorldIdentity& saved, const WantedWorld& wanted,
                                                      const GeneratorVersionOf& versionOf,
                                                      const std::string& where);

}  // namespace terrane::store
