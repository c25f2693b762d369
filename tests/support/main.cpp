// The entry point of all test programs. Beside GoogleTest's options it reads TERRANE_WITHOUT from the
// environment: patterns of cases that do not run, separated by colons as in --gtest_filter. Exit code 77 if
// every case was skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace {

constexpr int kAllSkipped = 77;  // SKIP_RETURN_CODE in tests/CMakeLists.txt

// GoogleTest: what follows the minus sign is left out.
void leaveOut(const std::string& patterns) {
    const std::string filter = GTEST_FLAG_GET(filter);
    GTEST_FLAG_SET(filter, filter + (filter.find('-') == std::string::npos ? "-" : ":") + patterns);
}

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleMock(&argc, argv);
    if (const char* patterns = std::getenv("TERRANE_WITHOUT"); patterns && *patterns) leaveOut(patterns);
    const int code = RUN_ALL_TESTS();
    const testing::UnitTest& all = *testing::UnitTest::GetInstance();
    return code == 0 && all.skipped_test_count() == all.test_to_run_count() ? kAllSkipped : code;
}
