// Whole files in and out. Any thread may call. Errors name the path and the system's reason, for example
// "saves/a.npy: cannot be written: No such file or directory".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::base {

[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path);

// Writes a temporary file beside the path, then renames it over the path: a reader, or a program that ends
// midway, finds the old file or the new one. (Not a promise for power cuts: nothing is synchronised to the
// disk.) A symbolic link is followed: the file it leads to is replaced, or made, and the link stays. Makes no
// folders and refuses to replace what is not a regular file, such as a folder
// or a device.
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace terrane::base
