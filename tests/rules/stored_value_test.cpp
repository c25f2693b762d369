#include "terrane/rules/stored_value.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace terrane::rules {
namespace {

std::string textOf(const StoredValue& value) {
    std::string text;
    encodeStored(text, value);
    return text;
}

StoredValue sample() {
    return {StoredValue::Table{
        {{std::int64_t{1}}, {std::string("a\nb%\xFF")}},
        {{std::string("home")}, {StoredValue::Table{{{std::string("x")}, {0.1}}, {{true}, {false}}}}},
        {{-2.5}, {std::numeric_limits<std::int64_t>::min()}}}};
}

TEST(StoredValue, IsPlainTextAndComesBack) {
    EXPECT_EQ(textOf(sample()), "{i1;s11:a%0Ab%25%FF;s4:home;{s1:x;d0.1;tf}d-2.5;i-9223372036854775808;}");
    EXPECT_EQ(decodeStored(textOf(sample())), sample());
}

TEST(StoredValue, OtherTextsAreRefused) {
    const std::string text = textOf(sample());
    for (std::size_t size = 0; size < text.size(); ++size)
        EXPECT_FALSE(decodeStored(text.substr(0, size))) << size;
    for (const char* wrong : {"",
                              "x",
                              "tt",
                              "i;",
                              "i1",
                              "i1.5;",
                              "i99999999999999999999;",
                              "dinf;",
                              "dnan;",
                              "d;",
                              "s5:abc;",
                              "s1:%;",
                              "s3:%zz;",
                              "s2:%4;",
                              "s-1:;",
                              "s99999999999999999999:a;",
                              "{t}",
                              "{{}t}",
                              "{",
                              "}",
                              " t"})
        EXPECT_FALSE(decodeStored(wrong)) << wrong;
}

TEST(StoredValue, TablesAreSixteenDeep) {
    const auto nested = [](int depth) {
        std::string text = "t";
        for (int k = 0; k < depth; ++k) text = "{i1;" + text + "}";
        return text;
    };
    EXPECT_TRUE(decodeStored(nested(kMaxStoredDepth)));
    EXPECT_FALSE(decodeStored(nested(kMaxStoredDepth + 1)));
    EXPECT_FALSE(decodeStored(std::string(kMaxStoredBytes, '{')));
}

// Each change of a byte gives nothing, or a value with a text of its own.
TEST(StoredValue, ChangedBytesDoNoHarm) {
    std::mt19937 random(7);
    for (int k = 0; k < 20'000; ++k) {
        std::string text = textOf(sample());
        text[random() % text.size()] = static_cast<char>(random());
        if (const auto value = decodeStored(text)) {
            EXPECT_EQ(decodeStored(textOf(*value)), value);
        }
    }
}

TEST(StoredValue, KeysAreNamesOfSettings) {
    EXPECT_EQ(escapedKey("home.Jörg 1"), "home.J%C3%B6rg%201");
}

}  // namespace
}  // namespace terrane::rules
