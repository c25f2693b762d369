#include "terrane/base/text.h"

#include <gtest/gtest.h>

#include "terrane/base/log.h"

namespace terrane::base {
namespace {

TEST(PrintableTest, TextStaysAsItIs) {
    EXPECT_EQ(printable(""), "");
    EXPECT_EQ(printable("a.sqlite: 5 % of \"grass\" \\ {}"), "a.sqlite: 5 % of \"grass\" \\ {}");
    EXPECT_EQ(printable("Grün, 草, 🌱, ñ"), "Grün, 草, 🌱, ñ");
}

TEST(PrintableTest, ControlCharactersAreEscaped) {
    EXPECT_EQ(printable("\x1b[2Jgone\x07"), "\\x1b[2Jgone\\x07");
    EXPECT_EQ(printable("one\ntwo\r\tthree\x7f"), "one\\x0atwo\\x0d\\x09three\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\xc2\\x9b31m")
        << "the escape sequence of C1";
    EXPECT_EQ(printable("a\u202Ecod\u2028"), "a\\xe2\\x80\\xaecod\\xe2\\x80\\xa8");
}

TEST(PrintableTest, BytesThatAreNoTextAreEscaped) {
    EXPECT_EQ(printable("\x80"), "\\x80");
    EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
    EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
    EXPECT_EQ(printable("\xe2\x82x"), "\\xe2\\x82x");
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "a longer form than needed";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "behind the last character";
}

TEST(PrintableTest, TheLogAndResultsArePrintable) {
    testing::internal::CaptureStderr();
    logWarning("the block {} is new", "\x1b]0;mine\x07\nterrane: all is well");
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "terrane: warning: the block \\x1b]0;mine\\x07\\x0aterrane: all is well is new\n");
    testing::internal::CaptureStdout();
    printLine("block: {}", "\x1b[31mred");
    std::fflush(stdout);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "block: \\x1b[31mred\n");
}

}  // namespace
}  // namespace terrane::base
