// Where a world is kept, as the player names it. A plain value, for any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "terrane/base/result.h"

namespace terrane::store {

struct WorldLocation {
    enum class Kind {
        Name,  // a save in the folder of saves (save_path.h)
        File,  // a SQLite file
        Url,   // a database, for example postgresql://host/name
    };
    Kind kind = Kind::Name;
    std::string text;
};

// "a://b" is a URL, "a/b" and "b.sqlite" are files, everything else is a name.
WorldLocation worldLocation(std::string text);

// The file that a name or a file stands for, whether it is there or not. An error for what cannot be the name
// of a save, and for a URL, which is no file.
[[nodiscard]] base::Result<std::filesystem::path> fileOf(const WorldLocation& location);

// Bytes on disk of the file and of what SQLite has not moved into it yet; 0 where there is none.
[[nodiscard]] std::uintmax_t bytesOnDisk(const WorldLocation& location);

}  // namespace terrane::store
