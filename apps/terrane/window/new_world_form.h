// The form for a new world: typed values and the world made from them. Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/terrane/option_values.h"
#include "apps/terrane/seed_text.h"

namespace terrane::app {

// A world to play: an existing file, or a new one.
struct ChosenWorld {
    std::filesystem::path file;
    std::optional<WrittenSeed> seed;  // for a new world
    std::optional<std::string> generator;
};

struct NewWorldForm {
    std::string name;
    std::string seed;  // empty: randomSeed
    std::string generator = WorldOptions::kDefaultGenerator;
    std::uint64_t randomSeed = 0;

    bool operator==(const NewWorldForm&) const = default;
};

// A form with the first free name of "World", "World 2", ….
NewWorldForm newForm(const std::filesystem::path& folder, std::uint64_t randomSeed);

// Ignores spaces around the seed.
[[nodiscard]] base::Result<WrittenSeed> seedOf(const NewWorldForm& form);

// Errors are one line for the player.
[[nodiscard]] base::Result<ChosenWorld> worldOf(const NewWorldForm& form,
                                                const std::filesystem::path& folder);

}  // namespace terrane::app
