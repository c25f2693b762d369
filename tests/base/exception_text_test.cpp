#include "terrane/base/result.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace terrane::base {
namespace {

TEST(ExceptionText, SaysWhatIsShort) {
    EXPECT_STREQ(textOf(std::bad_alloc()), "no memory");
    const std::system_error noThread(std::make_error_code(std::errc::resource_unavailable_try_again));
    EXPECT_EQ(std::string(textOf(noThread)).find("no thread can be started"), 0u);
    EXPECT_STREQ(textOf(std::runtime_error("a reason")), "a reason");
}

}  // namespace
}  // namespace terrane::base
