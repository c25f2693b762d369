// Recognizes files and folders of other programs by their first bytes, so that an import of something else
// says what it is and what can be imported. Called by `terrane import` when an import fails. Plain functions;
// any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::formats {

struct FileKind {
    std::string_view name;    // "a schematic of Luanti (.mts)"
    std::string_view format;  // of `terrane import` that reads it; empty: none
    std::string_view advice;  // if none reads it: what to do instead
};

// kindOfFile() looks at no more bytes of a file, and at 16 times as many decompressed ones.
constexpr std::size_t kKindBytes = std::size_t{1} << 20;

// Null if the kind is unknown. `fileName` is without folder; some files have no bytes of their own to
// recognize them by.
[[nodiscard]] const FileKind* kindOfFile(std::string_view fileName, std::string_view firstBytes);
// Null if it is unknown or cannot be read.
[[nodiscard]] const FileKind* kindOfFolder(const std::filesystem::path& folder);

// The error of an import as `format` (the name in `terrane import`). If the source is of another kind, a line
// that says so and what to do; else `error`. The line begins with the path.
[[nodiscard]] base::Error explained(const std::filesystem::path& source, std::string_view format,
                                    base::Error error);

}  // namespace terrane::formats
