// Rewriting grammars and the turtle that draws their words.
#include "terrane/gen/generators/trees/grammar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace terrane::gen::trees {
namespace {

std::string grown(std::string_view axiom, const std::vector<Rule>& rules, int rounds,
                  std::uint32_t seed = 1) {
    Random random(seed);
    return rewritten(axiom, rules, rounds, random);
}

// Lindenmayer's first example, algae: the lengths are Fibonacci's numbers.
TEST(Grammar, RewritesAllSymbolsAtOnce) {
    const std::vector<Rule> rules = {{'A', 1, "AB"}, {'B', 1, "A"}};
    EXPECT_EQ(grown("A", rules, 0), "A");
    EXPECT_EQ(grown("A", rules, 4), "ABAABABA");
    EXPECT_EQ(grown("A", rules, 10).size(), 144u);
}

TEST(Grammar, RulesOfASymbolHappenAsOftenAsTheyShould) {
    const std::string word = grown(std::string(10000, 'A'), {{'A', .2f, "B"}, {'A', .5f, "C"}}, 1);
    ASSERT_EQ(word.size(), 10000u);
    EXPECT_NEAR(static_cast<double>(std::count(word.begin(), word.end(), 'B')), 2000, 150);
    EXPECT_NEAR(static_cast<double>(std::count(word.begin(), word.end(), 'C')), 5000, 200);
    EXPECT_NEAR(static_cast<double>(std::count(word.begin(), word.end(), 'A')), 3000, 200)
        << "the rest stays";
}

TEST(Grammar, SeedsDecide) {
    const std::vector<Rule> rules = {{'A', .5f, "FA"}, {'A', .5f, "[&FA]A"}};
    EXPECT_EQ(grown("A", rules, 8, 7), grown("A", rules, 8, 7));
    EXPECT_NE(grown("A", rules, 8, 7), grown("A", rules, 8, 8));
}

TEST(Grammar, GrowthEnds) {
    EXPECT_LT(grown("A", {{'A', 1, "AA"}}, 1000).size(), 2 * kMaxSymbols + 1);
}

Growth drawn(std::string_view word, float angle = .25f, Point tropism = {}) {
    Random random(3);
    return growByGrammar({word, {}, 0, 2.0f, angle, .25f, .5f, 0.0f, tropism}, random);
}

void expectNear(Point a, Point b) {
    EXPECT_LT(lengthOf(a - b), .02f) << a.x << " " << a.y << " " << a.z;
}

TEST(Turtle, GoesUpFromTheFootAndReturnsToPlaces) {
    const Growth growth = drawn("F[F'FL]F");
    const Branches& b = growth.branches;
    const std::size_t root = b.size() - 5;  // the node at the foot
    ASSERT_EQ(growth.tufts.size(), 1u);
    expectNear(b[root].at, {0, 0, 0});
    expectNear(b[root + 1].at, {0, 0, 2});
    expectNear(b[root + 3].at, {0, 0, 5});  // the last step is half as long
    expectNear(growth.tufts[0].at, {0, 0, 5});
    expectNear(growth.tufts[0].along, {0, 0, 1});
    expectNear(b[root + 4].at, {0, 0, 4});  // from the place that the bracket remembered
    EXPECT_EQ(b[root + 4].parent, static_cast<int>(root) + 1);
}

// Four right angles about one axis lead back, and the path is flat.
TEST(Turtle, TurnsAboutEachOfItsAxes) {
    for (const char* word : {"F+F+F+F", "F-F-F-F", "F&F&F&F", "F^F^F^F"})
        expectNear(drawn(word).branches.back().at, {});
    expectNear(drawn("////F").branches.back().at, {0, 0, 2});
    // A roll between two turns about the same axis makes them perpendicular.
    const Growth growth = drawn("&F/&F");
    const Point first = growth.branches[growth.branches.size() - 2].at;
    const Point second = growth.branches.back().at - first;
    EXPECT_NEAR(first.z, 0, .02f);
    EXPECT_NEAR(first.x * second.x + first.y * second.y + first.z * second.z, 0, .05f);
}

TEST(Turtle, StepsKeepTheirLengthAfterManyTurns) {
    std::string word;
    for (int k = 0; k < 400; ++k) word += "F+&/";
    const Branches branches = drawn(word, .13f).branches;
    for (std::size_t k = branches.size() - 400; k < branches.size(); ++k) {
        const auto parent = static_cast<std::size_t>(branches[k].parent);
        EXPECT_NEAR(lengthOf(branches[k].at - branches[parent].at), 2.0f, .01f);
    }
}

TEST(Turtle, TropismBendsBranches) {
    EXPECT_GT(drawn("&FFFF", .25f, {0, 0, .2f}).branches.back().at.z, 2.0f);
    EXPECT_LT(drawn("&FFFF", .25f, {0, 0, -.2f}).branches.back().at.z, -2.0f);
}

}  // namespace
}  // namespace terrane::gen::trees
