// A folder for one test, removed with all its content at the end.
#pragma once

#include <filesystem>
#include <string>

#include "terrane/base/platform.h"

namespace terrane::base {

class TempFolder {
  public:
    // Tests of one process run one after the other, so the process number is enough.
    TempFolder()
        : path_(std::filesystem::temp_directory_path() /
                ("terrane_test_" + std::to_string(platform::processNumber()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    [[nodiscard]] long fileCount() const {
        return std::distance(std::filesystem::directory_iterator(path_),
                             std::filesystem::directory_iterator());
    }

  private:
    std::filesystem::path path_;
};

}  // namespace terrane::base
