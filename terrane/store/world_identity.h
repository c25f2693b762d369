// Which world a store holds, against the world that a program wants. Plain values and functions, for any
// thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::store {

// What a world's generated chunks follow from. It never changes during the life of a save, but for the
// version, when the world is regenerated.
struct WorldIdentity {
    std::uint64_t seed = 0;
    std::string generator;
    int generatorVersion = 0;

    bool operator==(const WorldIdentity&) const = default;
};

// What the player asks for. What is not given is taken from the world that is there.
struct WantedWorld {
    std::optional<std::uint64_t> seed;
    std::optional<std::string> generator;
    bool regenerate = false;  // all chunks by the program's version of the generator; edits are lost
};

// The version that the program has of a generator; 0: the program does not have it.
using GeneratorVersionOf = std::function<int(std::string_view generator)>;

// An error that says in one line how they differ and names `where`, unless they are equal: chunks of two
// generators do not fit together.
[[nodiscard]] base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& wanted,
                                             const std::string& where);

// Whether a saved world is the one that is wanted. Gives the version to regenerate its chunks by, or nothing:
// the world is taken as it is. An error where it is another world, or where the program lacks its generator,
// or has another version of it and the world is not to be regenerated.
[[nodiscard]] base::Result<std::optional<int>> compareWorld(const WorldIdentity& saved,
                                                            const WantedWorld& wanted,
                                                            const GeneratorVersionOf& versionOf,
                                                            const std::string& where);

}  // namespace terrane::store
