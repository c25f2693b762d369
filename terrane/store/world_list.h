// The worlds in the folder of saves: which there are, and renaming, copying and deleting them. A world's name
// is the name of its file without ".sqlite". Called by the title screen; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/metadata.h"
#include "terrane/store/sqlite.h"
#include "terrane/store/world_identity.h"
#include "terrane/world/block_registry.h"

namespace terrane::store {

struct WorldEntry {
    std::string name;
    std::filesystem::path path;
    WorldIdentity identity;
    Metadata metadata;                           // such as where the player stood
    std::uintmax_t sizeBytes = 0;                // with its log
    std::filesystem::file_time_type lastPlayed;  // when the save was written last
    std::string inUse;    // "open in another program (process 12)"; empty: nobody has it
    std::string problem;  // why it cannot be read, one line; identity and metadata are then empty
};

// The last played first; none where there is no folder. Opens the first 1,000 saves of the folder.
std::vector<WorldEntry> listWorlds(const std::filesystem::path& folder, const world::BlockRegistry& blocks);

// An error for a name that no world can be found by: as checkSaveName(), and one that ends like a file's name
// (".sqlite") or with a space or a dot.
[[nodiscard]] base::Result<void> checkWorldName(std::string_view name);

std::filesystem::path worldFile(const std::filesystem::path& folder, std::string_view name);
// The picture that a list shows, beside the save; it may not be there.
std::filesystem::path thumbnailOf(const std::filesystem::path& save);

// "World" or "World 2": the first that no file has. Cut where it would be too long.
std::string freeWorldName(const std::filesystem::path& folder, std::string_view wanted);

// Each takes the thumbnail along. Errors: BadInput for a bad name or one that another world has, NotFound,
// Busy where another program has the world, Incompatible for a link.
[[nodiscard]] base::Result<void> renameWorld(const std::filesystem::path& folder, std::string_view name,
                                             std::string_view newName);
[[nodiscard]] base::Result<void> deleteWorld(const std::filesystem::path& folder, std::string_view name);

struct WorldCopy {
    std::string name, newName;
};
// As the world is saved at this moment, also while it is played. What a copy that fails leaves is removed.
[[nodiscard]] base::Result<void> copyWorld(const std::filesystem::path& folder, const WorldCopy& copy,
                                           const world::BlockRegistry& blocks, const CopyProgress& progress);

}  // namespace terrane::store
