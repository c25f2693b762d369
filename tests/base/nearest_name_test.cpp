#include "terrane/base/text.h"

#include <gtest/gtest.h>

#include <vector>

namespace terrane::base {
namespace {

TEST(EditDistance, CountsChanges) {
    EXPECT_EQ(editDistance("", ""), 0u);
    EXPECT_EQ(editDistance("", "abc"), 3u);
    EXPECT_EQ(editDistance("abc", ""), 3u);
    EXPECT_EQ(editDistance("render", "render"), 0u);
    EXPECT_EQ(editDistance("rendr", "render"), 1u) << "inserted";
    EXPECT_EQ(editDistance("seeed", "seed"), 1u) << "deleted";
    EXPECT_EQ(editDistance("food", "fool"), 1u) << "replaced";
    EXPECT_EQ(editDistance("dupm", "dump"), 1u) << "swapped";
    EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
    EXPECT_EQ(editDistance("ca", "abc"), 3u) << "what was swapped stays";
}

TEST(EditDistance, IsTheSameBothWays) {
    const std::vector<std::string> words = {"", "a", "ab", "ba", "abc", "acb", "bca", "xabcy", "generate"};
    for (const std::string& a : words)
        for (const std::string& b : words) EXPECT_EQ(editDistance(a, b), editDistance(b, a)) << a << " " << b;
}

TEST(NearestName, IsTheOneMeant) {
    const std::vector<std::string> names = {"render", "record", "map", "dump", "generate"};
    EXPECT_EQ(nearestName("rendr", names), "render");
    EXPECT_EQ(nearestName("recrod", names), "record");
    EXPECT_EQ(nearestName("mpa", names), "map");
    EXPECT_EQ(nearestName("genrrate", names), "generate");
    EXPECT_EQ(nearestName("map", names), "map");
    EXPECT_EQ(nearestName("rexder", names), "render") << "two of six differ from record in more";
    for (const std::string word : {"", "x", "frobnicate", "-", "mxx"})
        EXPECT_EQ(nearestName(word, names), "") << word;
    EXPECT_EQ(nearestName(std::string(1000000, 'x'), names), "");
    EXPECT_EQ(nearestName("aa", std::vector<std::string>{"ab", "ac"}), "ab") << "the first of equals";
    EXPECT_EQ(nearestName("a", {}), "");
}

TEST(NearestName, AsAQuestion) {
    const std::vector<std::string> names = {"low", "high"};
    EXPECT_EQ(didYouMean("hihg", names), "; did you mean high?");
    EXPECT_EQ(didYouMean("nothing", names), "");
    EXPECT_EQ(expectedOneOf(names, "hihg"), "expected one of low, high, got \"hihg\"; did you mean high?");
}

}  // namespace
}  // namespace terrane::base
