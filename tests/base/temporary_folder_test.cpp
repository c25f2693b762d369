#include "terrane/base/files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>

namespace terrane::base {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, GoesWithAllThatIsInIt) {
    fs::path first, second;
    {
        auto a = TemporaryFolder::make(fs::temp_directory_path(), ".terrane-test-");
        auto b = TemporaryFolder::make(fs::temp_directory_path(), ".terrane-test-");
        ASSERT_TRUE(a && b);
        first = a->path();
        second = b->path();
        EXPECT_NE(first, second);
        std::ofstream(first / "file") << "text";
        const TemporaryFolder moved = std::move(*a);
        EXPECT_EQ(moved.path(), first);
        EXPECT_TRUE(fs::exists(first / "file"));
    }
    EXPECT_FALSE(fs::exists(first));
    EXPECT_FALSE(fs::exists(second));
}

TEST(TemporaryFolder, TellsWhereNoneCanBeMade) {
    const auto made = TemporaryFolder::make("/nonexistent/folder", "a-");
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("/nonexistent/folder"), std::string::npos);
}

}  // namespace
}  // namespace terrane::base
