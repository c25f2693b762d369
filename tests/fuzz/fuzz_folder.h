// A folder for files that the library opens by name: in TMPDIR, else in /dev/shm, which is in memory. Removed
// at exit.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/files.h"
#include "tests/fuzz/fuzz_input.h"

namespace terrane::fuzz {

inline const std::filesystem::path& fuzzFolder() {
    static const base::TemporaryFolder folder = [] {
        const char* given = std::getenv("TMPDIR");
        auto made = base::TemporaryFolder::make(given ? given : "/dev/shm", "terrane-fuzz-");
        if (!made) std::fprintf(stderr, "%s\n", made.error().message.c_str());
        require(made.has_value());
        return std::move(*made);
    }();
    return folder.path();
}

// Faster than streams.
inline void writeWhole(const std::filesystem::path& path, std::string_view bytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    require(file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size());
    require(std::fclose(file) == 0);
}

// Empty if there is no file.
inline std::string readWhole(const std::filesystem::path& path) {
    std::string bytes;
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (!file) return bytes;
    char part[16384];
    while (const std::size_t count = std::fread(part, 1, sizeof part, file)) bytes.append(part, count);
    std::fclose(file);
    return bytes;
}

// Deletes all files of the last input.
inline void emptyFolder() {
    for (const auto& entry : std::filesystem::directory_iterator(fuzzFolder()))
        std::filesystem::remove_all(entry.path());
}

}  // namespace terrane::fuzz
