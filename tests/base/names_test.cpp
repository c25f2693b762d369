#include "terrane/base/names.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace terrane::base {
namespace {

using testing::HasSubstr;

constexpr std::size_t kRoom = 60;

TEST(Names, OfManyScriptsAreGood) {
    for (const std::string name :
         {"A",       "Ann",   "The old mill", "World 2", "a.b",    "-x",         "O'Brien",
          "Můj dům", "Žofie", "Мир",          "Αθήνα",   "世界",   "ひらカタ漢", "서울 Bob",
          "Bob 家",  "שלום",  "عربي",         "ที่ Bob",   "🐸 pond", "<b>x</b>",   "';--"}) {
        const auto checked = checkName(name, kRoom);
        ASSERT_TRUE(checked) << name << ": " << checked.error().message;
        EXPECT_EQ(*checked, name);
    }
}

TEST(Names, AreBroughtToTheirNormalForm) {
    EXPECT_EQ(*checkName("A\u0301nn", kRoom), "Ánn");
    EXPECT_EQ(*checkName("\u1100\u1161", kRoom), "가");
    EXPECT_EQ(normalizedName("A\u0301nn"), "Ánn");
    EXPECT_EQ(normalizedName("\xff"), "\xff") << "bytes that are no text stay";
}

TEST(Names, HaveNothingInvisible) {
    // Zero-width space and joiner, soft hyphen, byte order mark, fillers, blanks, tags, variation selectors,
    // marks of direction, line separators.
    for (const std::string name :
         {"Ann\u200b", "An\u200dn", "\u3164", "\uffa0", "\u115f", "Ann\u00ad", "\u2800", "\u00a0", "a\u2003b",
          "\ufeffAnn", "Ann\u2060", "\U000e0041nn", "Ann\ufe0f", "\u202eAnn", "Ann\u2028", "\ufff9",
          "\U0001d159", "Ann\u034f", "a\u0301\u0301"})
        EXPECT_FALSE(checkName(name, kRoom)) << testing::PrintToString(name);
    EXPECT_EQ(checkName("Ann\u200b", kRoom).error().message, "a name cannot have the character U+200B");
}

TEST(Names, HaveNoControlsAndAreText) {
    for (const std::string name :
         {"a\nb", "\x1b[31m", "a\x7f", "\u0085", "\xff", "\xed\xa0\x80", "\ue000", "\uffff"})
        EXPECT_FALSE(checkName(name, kRoom)) << testing::PrintToString(name);
    EXPECT_FALSE(checkName(std::string_view("a\0b", 3), kRoom));
}

TEST(Names, DoNotMixScriptsThatLookAlike) {
    for (const std::string name : {"\u0391nn", "Anп", "Дом Bob", "Bob Ελ", "1٣"})
        EXPECT_FALSE(checkName(name, kRoom)) << name;
    EXPECT_THAT(checkName("\u0391nn", kRoom).error().message, HasSubstr("scripts"));
}

TEST(Names, HaveALengthAndNoSpacesAtTheirEnds) {
    EXPECT_TRUE(checkName(std::string(kRoom, 'n'), kRoom));
    for (const std::string& name :
         {std::string(), std::string(kRoom + 1, 'n'), std::string(1 << 20, 'n'), std::string(" a"),
          std::string("a "), std::string("a  b"), std::string(" "), std::string("\u0301a")})
        EXPECT_FALSE(checkName(name, kRoom)) << name.substr(0, 70);
    EXPECT_THAT(checkName(std::string(kRoom + 1, 'n'), kRoom).error().message, HasSubstr("60 bytes"));
    EXPECT_FALSE(checkName(std::string(kRoom - 1, 'n') + "é", kRoom)) << "bytes count";
}

TEST(Names, ThatLookAlikeAreConfusable) {
    EXPECT_TRUE(isConfusable("Ann", "Ann"));
    EXPECT_TRUE(isConfusable("ANN", "ann")) << "case";
    EXPECT_TRUE(isConfusable("ŽOFIE", "žofie"));
    EXPECT_TRUE(isConfusable("Ian", "lan")) << "capital I and small l";
    EXPECT_TRUE(isConfusable("bot1", "botl"));
    EXPECT_TRUE(isConfusable("Ann", "\u0391nn")) << "Greek";
    EXPECT_TRUE(isConfusable("Scope", "Ѕсоре")) << "Cyrillic";
    EXPECT_TRUE(isConfusable("Bemd", "Bernd"));
    EXPECT_TRUE(isConfusable("Ann", "A\uff4en")) << "full width";
    EXPECT_TRUE(isConfusable("Ánn", "A\u0301nn"));
    for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{{"Ann", "Anna"},
                                                                               {"Ann", "Ánn"},
                                                                               {"bot 10", "bot 11"},
                                                                               {"世界", "世"},
                                                                               {"World", "World 2"},
                                                                               {"", "A"}})
        EXPECT_FALSE(isConfusable(a, b)) << a << " " << b;
}

TEST(Names, TheFirstThatLooksAlikeIsFound) {
    const std::vector<std::string> known{"home", "mill", "rnill"};
    EXPECT_EQ(nameLike("Mill", known), "mill");
    EXPECT_EQ(nameLike("mi1l", known), "mill");
    EXPECT_EQ(nameLike("tower", known), "");
}

}  // namespace
}  // namespace terrane::base
