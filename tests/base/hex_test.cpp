#include "terrane/base/text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace terrane::base {
namespace {

TEST(Hex, EachByteInUpperAndLowerCase) {
    for (int byte = 0; byte < 256; ++byte) {
        const std::string lower = fmt::format("{:02x}", byte), upper = fmt::format("{:02X}", byte);
        EXPECT_EQ(hexByte(lower[0], lower[1]), byte);
        EXPECT_EQ(hexByte(upper[0], upper[1]), byte);
    }
}

TEST(Hex, OnlyDigits) {
    for (int c = 0; c < 256; ++c) {
        const bool isDigit =
            std::string("0123456789abcdefABCDEF").find(static_cast<char>(c)) != std::string::npos;
        EXPECT_EQ(hexByte(static_cast<char>(c), '0').has_value(), isDigit) << c;
        EXPECT_EQ(hexByte('0', static_cast<char>(c)).has_value(), isDigit) << c;
    }
}

}  // namespace
}  // namespace terrane::base
