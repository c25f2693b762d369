#include "terrane/web/route.h"

#include <gmock/gmock.h>

namespace terrane::web {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Segments = std::vector<std::string>;

TEST(Target, PathsAreSegments) {
    EXPECT_THAT(parseTarget("/").value().segments, IsEmpty());
    EXPECT_THAT(parseTarget("/a").value().segments, ElementsAre("a"));
    EXPECT_THAT(parseTarget("/tiles/day/-3/4/-5.png").value().segments,
                ElementsAre("tiles", "day", "-3", "4", "-5.png"));
    EXPECT_THAT(parseTarget("/a%20b/%C3%A9+~%25").value().segments, ElementsAre("a b", "\xC3\xA9+~%"));
    EXPECT_THAT(parseTarget("/.../..a/a..").value().segments, ElementsAre("...", "..a", "a.."));
}

TEST(Target, QueriesAreParameters) {
    const Target target = parseTarget("/api/block?x=-5&y=%37&empty=&alone&x=9&a=b=c").value();
    EXPECT_THAT(target.segments, ElementsAre("api", "block"));
    EXPECT_EQ(target.query.size(), 6u);
    EXPECT_EQ(target.parameter("x"), "-5") << "the first one";
    EXPECT_EQ(target.parameter("y"), "7");
    EXPECT_EQ(target.parameter("empty"), "");
    EXPECT_EQ(target.parameter("alone"), "");
    EXPECT_EQ(target.parameter("a"), "b=c");
    EXPECT_FALSE(target.parameter("z"));
    EXPECT_FALSE(target.parameter(""));
    EXPECT_THAT(parseTarget("/?").value().query, IsEmpty());
    EXPECT_THAT(parseTarget("/?x=1").value().segments, IsEmpty());
    EXPECT_EQ(parseTarget("/?path=/../%2e%2e").value().parameter("path"), "/../..");
}

TEST(Target, NoPathLeadsUpward) {
    for (const char* text :
         {"/..",   "/../", "/a/..",  "/a/../b",      "/.",       "/./a",  "/%2e%2e", "/%2E%2e/etc/passwd",
          "/.%2e", "/%2e", "/a%2fb", "/a%2Fb",       "/..%2f..", "/a\\b", "/a%5cb",  "/..%5C..",
          "/a%00", "/%00", "//",     "//etc/passwd", "/a//b",    "/a/",   "/a/b/"})
        EXPECT_FALSE(parseTarget(text)) << text;
}

// Escapes are decoded once: the result is a name, never a parent folder.
TEST(Target, EscapesOfEscapesAreText) {
    EXPECT_EQ(parseTarget("/%252e%252e").value().segments, Segments{"%2e%2e"});
    EXPECT_EQ(parseTarget("/%252f").value().segments, Segments{"%2f"});
    EXPECT_EQ(parseTarget("/%25").value().segments, Segments{"%"});
}

TEST(Target, OnlyAbsolutePathsCount) {
    for (const char* text : {"", "a", "*", "http://host/a", "host:80", "?x=1", " /", "/a b", "/a\tb",
                             "/a\r\nb", "/\x7f", "/\xC3\xA9", "/?\x01"})
        EXPECT_FALSE(parseTarget(text)) << text;
    EXPECT_FALSE(parseTarget(std::string_view("/a\0b", 4)));
}

TEST(Target, WrongEscapesAreRefused) {
    for (const char* text : {"/%", "/%2", "/a%", "/a%4", "/%zz", "/%4g", "/%g4", "/%%41", "/%u0041", "/?x=%",
                             "/?%4=1", "/?x=%-1"})
        EXPECT_FALSE(parseTarget(text)) << text;
    EXPECT_EQ(parseTarget("/%41").value().segments, Segments{"A"});
    EXPECT_EQ(parseTarget("/%4A%4a").value().segments, Segments{"JJ"});
}

TEST(Target, LengthAndPartsAreLimited) {
    EXPECT_TRUE(parseTarget("/" + std::string(kMaxTargetBytes - 1, 'a')));
    EXPECT_FALSE(parseTarget("/" + std::string(kMaxTargetBytes, 'a')));
    EXPECT_TRUE(parseTarget("/1/2/3/4/5/6/7/8"));
    EXPECT_FALSE(parseTarget("/1/2/3/4/5/6/7/8/9"));
    EXPECT_TRUE(parseTarget("/?1&2&3&4&5&6&7&8"));
    EXPECT_FALSE(parseTarget("/?1&2&3&4&5&6&7&8&9"));
    EXPECT_FALSE(parseTarget("/?" + std::string(100, '&')));
}

}  // namespace
}  // namespace terrane::web
