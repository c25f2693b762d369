// What a player types to make a world, and what is made of it. Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/terrane/option_values.h"
#include "apps/terrane/seed_text.h"

namespace terrane::app {

// A world that is to be played: an existing file, or one to be made there.
struct ChosenWorld {
    std::filesystem::path file;
    std::optional<WrittenSeed> seed;  // of a new world
    std::optional<std::string> generator;
};

struct NewWorldForm {
    std::string name;
    std::string seed;  // empty: the random one
    std::string generator = WorldOptions::kDefaultGenerator;
    std::uint64_t randomSeed = 0;

    bool operator==(const NewWorldForm&) const = default;
};

// A form with the first free name of "World", "World 2", ….
NewWorldForm newForm(const std::filesystem::path& folder, std::uint64_t randomSeed);

// Spaces around a seed are a slip, not a part of it.
[[nodiscard]] base::Result<WrittenSeed> seedOf(const NewWorldForm& form);

// An error, one line for the player, where no world can be made so.
[[nodiscard]] base::Result<ChosenWorld> worldOf(const NewWorldForm& form,
                                                const std::filesystem::path& folder);

}  // namespace terrane::app
