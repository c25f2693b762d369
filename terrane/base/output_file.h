// A file that is written in pieces, for results larger than memory. One thread at a time may use it. Errors
// name the path and the system's reason, like those of files.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::base {

// The file has no name in the path's folder until finish() gives it its name. Without finish() no file is
// left, even if the program is killed, and an older file of that name is unchanged. If the file system does
// not support files without a name, and for an instant in finish(), it has a temporary name, which a killed
// program leaves behind.
class OutputFile {
  public:
    // Follows symbolic links: the target is replaced or created, and the link stays. Creates no folders, and
    // refuses to replace anything but a regular file.
    [[nodiscard]] static Result<OutputFile> create(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;

    // Reserves disk space; fails if so many bytes do not fit. If the file system cannot reserve space, only
    // compares with the free space.
    [[nodiscard]] Result<void> reserve(std::uint64_t sizeBytes);

    // Gaps between pieces read as 0.
    [[nodiscard]] Result<void> write(std::uint64_t offsetBytes, std::string_view bytes);

    // Waits until the data is on disk, then renames the file to the path: readers find the old file or the
    // new one, also after a crash or power failure. It is called once, as the last call.
    [[nodiscard]] Result<void> finish();

  private:
    OutputFile(int descriptor, std::filesystem::path path, std::filesystem::path temporary)
        : descriptor_(descriptor), path_(std::move(path)), temporary_(std::move(temporary)) {}
    int close();
    int nameTemporarily();

    int descriptor_ = -1;
    std::filesystem::path path_, temporary_;  // empty while the file has no name
};

}  // namespace terrane::base
