// An empty folder for one test, removed at its end.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/files.h"

namespace terrane::gpu {

class ScratchFolder {
  public:
    // Tests of one program may run at the same time: the name holds the process and the test.
    ScratchFolder() {
        const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
        const std::string name = std::string("terrane_") + test->test_suite_name() + "_" + test->name() + "_";
        path_ = std::filesystem::path(testing::TempDir()) / (name + std::to_string(getpid()));
        std::filesystem::create_directories(path_);
    }
    ~ScratchFolder() { std::filesystem::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    void write(std::string_view name, std::string_view text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        const base::Result<void> written = base::writeFile(path_ / name, text);
        ASSERT_TRUE(written) << written.error().message;
    }

  private:
    std::filesystem::path path_;
};

}  // namespace terrane::gpu
