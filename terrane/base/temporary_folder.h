// A folder for temporary files. Any thread.
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

#include "terrane/base/result.h"

namespace terrane::base {

// The destructor removes the folder and all its content.
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
