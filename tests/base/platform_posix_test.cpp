#include "terrane/base/platform.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"

namespace terrane::base::platform {
namespace {

// Sets a variable of the environment for one test.
class Variable {
  public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* found = std::getenv(name)) before_ = found;
        value ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST(Platform, FoldersOfTheUserAreThoseOfXdg) {
    const Variable home("HOME", "/home/me"), data("XDG_DATA_HOME", "/data"),
        settings("XDG_CONFIG_HOME", "relative"), cache("XDG_CACHE_HOME", nullptr);
    EXPECT_EQ(userFolder(UserFolder::Data), "/data");
    EXPECT_EQ(userFolder(UserFolder::Settings), "/home/me/.config");
    EXPECT_EQ(userFolder(UserFolder::Cache), "/home/me/.cache");
    const Variable noData("XDG_DATA_HOME", "");
    EXPECT_EQ(userFolder(UserFolder::Data), "/home/me/.local/share");
    for (const char* nowhere : {"", "relative"}) {
        const Variable noHome("HOME", nowhere);
        EXPECT_EQ(userFolder(UserFolder::Data), "") << nowhere;
    }
}

// Reading returns soon and within the allowed memory, whatever the name stands for.
TEST(Platform, OnlyRegularFilesAreRead) {
    const TempFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const std::filesystem::path& path : {folder / "pipe", std::filesystem::path("/dev/zero")}) {
        const Result<std::string> result = readFile(path);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().message, path.string() + ": cannot be read: it is not a regular file");
    }
}

TEST(Platform, WritingOverADeviceIsRefused) {
    const Result<void> result = writeFile("/dev/null", "a");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "/dev/null: cannot be written: it is not a regular file");
}

}  // namespace
}  // namespace terrane::base::platform
