// The location of a world as given by the player. A plain value, for any thread.
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

// The file of a name or path, whether it exists or not. Fails for an invalid save name, and for a URL.
[[nodiscard]] base::Result<std::filesystem::path> fileOf(const WorldLocation& location);

// Bytes on disk of the file and its log; 0 if there is none.
[[nodiscard]] std::uintmax_t bytesOnDisk(const WorldLocation& location);

}  // namespace terrane::store
