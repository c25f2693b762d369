// Reads and writes whole files. Any thread may call the functions. Errors name the path and the system's
// reason, for example "saves/a.npy: cannot be written: No such file or directory".
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "terrane/base/result.h"

namespace terrane::base {

// Files compiled into the program (shaders, content, textures). tools/embed_files.py writes the tables.
struct EmbeddedFile {
    std::string_view path;  // as the CMake list names it, for example "terrane/render/sky/sky.frag.glsl"
    std::string_view data;  // the whole file; lives as long as the program
};

// Default limit for files that are read whole.
constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;

// Reads a regular file of at most `maxBytes`. Larger files, devices and pipes are refused before they are
// read.
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path,
                                           std::size_t maxBytes = kMaxFileBytes);

// Writes a file in one piece, as OutputFile does (output_file.h).
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::string_view bytes);

struct FileToWrite {
    std::filesystem::path path;
    std::string_view bytes;
};
// Writes several files: all or none. Files get their names after all bytes are on the disk; if that fails for
// one of them, the ones before it are removed.
[[nodiscard]] Result<void> writeFiles(std::span<const FileToWrite> files);

// Creates a file that only its owner may read, for keys. Fails if it exists; leaves no partial file. The
// bytes are on the disk when it returns.
[[nodiscard]] Result<void> writePrivateFile(const std::filesystem::path& path, std::string_view bytes);

// A folder for temporary files. Any thread may use it. The destructor removes the folder and all its content.
class TemporaryFolder {
  public:
    // Makes a folder with a new name in `parent`, which may hold files of the user.
    [[nodiscard]] static Result<TemporaryFolder> make(const std::filesystem::path& parent,
                                                      std::string_view prefix);
    ~TemporaryFolder();
    TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

    std::filesystem::path path_;
};

}  // namespace terrane::base
