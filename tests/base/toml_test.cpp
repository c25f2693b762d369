#include "terrane/base/toml.h"

#include <gmock/gmock.h>

#include <string>

namespace terrane::base {
namespace {

using testing::HasSubstr;

std::string errorOf(std::string_view text) {
    const auto table = parseToml(text, "a.toml");
    return table ? "" : table.error().message;
}

std::string keyOf(int parts) {
    std::string key = "a";
    for (int k = 1; k < parts; ++k) key += " . a";
    return key;
}

TEST(Toml, ErrorsNameFileAndLine) {
    EXPECT_EQ(errorOf("a = 1\nb = [1.5, 2.5]"), "");
    EXPECT_THAT(errorOf("a = 1\nb = \n"), testing::StartsWith("a.toml:2: syntax: "));
    EXPECT_THAT(errorOf("a = \"\x01\n\""), testing::Not(HasSubstr("\n")));
}

// 60,000 parts overflowed the stack.
TEST(Toml, KeysOfManyPartsAreRefused) {
    const std::string longest = keyOf(kMaxKeyParts), longer = keyOf(kMaxKeyParts + 1);
    EXPECT_EQ(errorOf(longest + " = 1"), "");
    for (const std::string& text :
         {longer + " = 1", "\n[" + longer + "]", "\nb = {" + longer + " = 1}", "\n[[" + longer + "]]",
          "\nb = \"\"\"x\"\"\"\"\n" + longer + " = 1", "\nb = 'x'\n'c'." + longer + " = 1",
          "\nb = [\"\"\"x\"\"\"\", {" + longer + " = 1}]", "\nb = \"\\\"\"\n" + longer + " = 1"})
        EXPECT_THAT(errorOf(text), HasSubstr("a key has more than 16 parts")) << text;
    EXPECT_THAT(errorOf("\n\n" + keyOf(100'000) + " = 1"), testing::StartsWith("a.toml:3: "));
}

TEST(Toml, TextsAndNumbersAreNoKeys) {
    const std::string dots(100, '.');
    for (const std::string& text : {"a = \"" + dots + "\"", "a = '" + dots + "'", "# " + dots,
                                    "a = '''\n" + dots + "\n'''", "a = \"\"\"\n" + dots + "\n\\\"\"\"\"",
                                    "a = [" + std::string(100, ' ') +
                                        "1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, "
                                        "9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5, 16.5, 17.5]"})
        EXPECT_EQ(errorOf(text), "") << text;
}

}  // namespace
}  // namespace terrane::base
