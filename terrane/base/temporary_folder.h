// A folder of its own for files that nobody needs afterwards. Any thread.
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

#include "terrane/base/result.h"

namespace terrane::base {

// Removed at the end with all that is in it.
class TemporaryFolder {
  public:
    // In `parent`, by a name that nobody had before: files of the user may lie beside it.
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
