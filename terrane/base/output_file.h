// A file that is written piece by piece, for results that are larger than memory. One thread at a time.
// Errors name the path and the system's reason, as those of files.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::base {

// Written without a name in the path's folder; finish() gives it its name. Without finish() nothing stays,
// also of a program that is killed, and an older file of that name is as it was. Where the file system knows
// no files without a name, and for an instant in finish(), it has a temporary one, which a killed program
// leaves.
class OutputFile {
  public:
    // A symbolic link is followed: the file it leads to is replaced, or made, and the link stays. Makes no
    // folders and refuses to replace what is not a regular file, such as a folder or a device.
    [[nodiscard]] static Result<OutputFile> create(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;

    // Fails at once where so many bytes do not fit the disk. Where the file system cannot reserve them, only
    // what is free now is compared.
    [[nodiscard]] Result<void> reserve(std::uint64_t sizeBytes);

    // What is left out between pieces is 0.
    [[nodiscard]] Result<void> write(std::uint64_t offsetBytes, std::string_view bytes);

    // Waits until the disk has it, then renames it over the path: a reader finds the old file or the new one,
    // also after a program, or the power, has ended midway. Called once, nothing after it.
    [[nodiscard]] Result<void> finish();

  private:
    OutputFile(int descriptor, std::filesystem::path path, std::filesystem::path temporary)
        : descriptor_(descriptor), path_(std::move(path)), temporary_(std::move(temporary)) {}
    int close();
    int nameTemporarily();
    int rename();

    int descriptor_ = -1;
    std::filesystem::path path_, temporary_;  // empty while the file has no name
};

}  // namespace terrane::base
