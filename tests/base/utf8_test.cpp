#include "terrane/base/text.h"

#include <gtest/gtest.h>

#include <string>

namespace terrane::base {
namespace {

TEST(Utf8, FirstCharacters) {
    EXPECT_EQ(firstCodePoint("a").code, U'a');
    EXPECT_EQ(firstCodePoint("čx").code, U'č');
    EXPECT_EQ(firstCodePoint("čx").bytes, 2u);
    EXPECT_EQ(firstCodePoint("€").bytes, 3u);
    EXPECT_EQ(firstCodePoint("\U0010FFFF").code, char32_t{0x10FFFF});
}

TEST(Utf8, WhatIsNone) {
    for (const char* text : {"\x80", "\xC3", "\xC0\xAF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                             "\xF5\x80\x80\x80", "\xE2\x82", "\xFF", "ok\xE2"})
        EXPECT_FALSE(isUtf8(text)) << text;
    EXPECT_TRUE(isUtf8(""));
    EXPECT_TRUE(isUtf8(std::string_view("a\0b", 3)));
    EXPECT_TRUE(isUtf8("Žluťoučký kůň, 木, 🌲"));
}

// Each code has exactly one valid form.
TEST(Utf8, ExactlyTheCodesOfUnicode) {
    std::size_t count = 0;
    for (unsigned first = 0; first < 256; ++first)
        for (unsigned second = 0; second < 256; ++second)
            for (unsigned third = 0; third < 256; ++third) {
                const std::string text{static_cast<char>(first), static_cast<char>(second),
                                       static_cast<char>(third)};
                if (firstCodePoint(text).bytes == 3) ++count;
            }
    EXPECT_EQ(count, 0x10000u - 0x800u - 0x800u) << "from U+0800 on, without surrogates";
}

}  // namespace
}  // namespace terrane::base
