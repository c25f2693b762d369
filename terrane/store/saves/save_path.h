// Paths of saves by name. It is called by programs while they start; reads the environment, which no thread
// may change meanwhile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::store {

// The location of a world as given by the player. A plain value, for any thread.
struct WorldLocation {
    enum class Kind {
        Name,  // a save in the folder of saves
        File,  // a SQLite file
        Url,   // a database, for example postgresql://host/name
    };
    Kind kind = Kind::Name;
    std::string text;
};

// Parses a location: "a://b" is a URL, "a/b" and "b.sqlite" are files, everything else is a name.
WorldLocation worldLocation(std::string text);

// Returns the file of a name or path, whether it exists or not; of a symbolic link, the file that it leads
// to. Fails for an invalid save name, and for a URL.
[[nodiscard]] base::Result<std::filesystem::path> fileOf(const WorldLocation& location);

// Returns the bytes on disk of the file and its log; 0 if there is none.
[[nodiscard]] std::uintmax_t bytesOnDisk(const WorldLocation& location);

// The environment from which paths are made.
struct SaveEnvironment {
    std::filesystem::path data;  // base::platform::userFolder(); empty if there is none
    std::filesystem::path legacyFolder =
        "save";  // folder of saves up to version 0.1, below the working directory
};

// Returns the values of this process.
SaveEnvironment saveEnvironment();

// Returns the folder of players' worlds and other files, "terrane" in the user's data. Absolute; may not
// exist.
[[nodiscard]] base::Result<std::filesystem::path> dataFolder(const SaveEnvironment& places);

constexpr std::size_t kMaxSaveName = 100;  // bytes; file systems allow 255, including extensions
// Fails for a name that cannot be a file name: empty, longer than 100 bytes, with a slash or a control
// character, or with a leading dot or space.
[[nodiscard]] base::Result<void> checkSaveName(std::string_view name);

// Also fails for a name that no new save or structure can have: see base/names.h. Names that exist stay.
[[nodiscard]] base::Result<void> checkNewName(std::string_view name);
// Another save in the folder whose name is confusable with this one; empty if there is none. `former`: a save
// that gets this name, which does not count.
[[nodiscard]] std::string saveLike(const std::filesystem::path& folder, std::string_view name,
                                   std::string_view former = {});

// NAME.sqlite in the data folder, or in the former folder if it exists only there; then the path is relative.
// A name that no file has is found in its normal form; errors of checkSaveName(), and if there is no file, of
// checkNewName() and for a name that looks like that of another save. Creates no folders.
[[nodiscard]] base::Result<std::filesystem::path> savePath(std::string_view name,
                                                           const SaveEnvironment& places);

}  // namespace terrane::store
