#include "apps/terrane/bench/bench_plan.h"

#include <gmock/gmock.h>

#include <set>

namespace terrane::app {
namespace {

using testing::ElementsAre;

std::vector<std::string> keysOf(const std::vector<Cell>& cells) {
    std::vector<std::string> keys;
    for (const Cell& cell : cells) keys.push_back(keyOf(cell));
    return keys;
}

TEST(PlanLine, IsEveryCombination) {
    EXPECT_THAT(keysOf(expandLine("info")), ElementsAre("info"));
    EXPECT_THAT(keysOf(expandLine("render --scene a,b --layers 0,3")),
                ElementsAre("render --scene a --layers 0", "render --scene a --layers 3",
                            "render --scene b --layers 0", "render --scene b --layers 3"));
}

TEST(PlanLine, AFlagGivenAgainKeepsItsPlace) {
    EXPECT_THAT(keysOf(expandLine("render --scene a,b --layers 3 --scene c,d")),
                ElementsAre("render --scene c --layers 3", "render --scene d --layers 3"));
}

TEST(Plan, HasEachCellOnce) {
    const Cell one{{"render", "--scene", "a"}}, other{{"render"}},
        again{{"render", "--scene", "a"}, {"before"}};
    EXPECT_THAT(keysOf(uniqueCells({{"x", {one, other}}, {"y", {again, one}}})),
                ElementsAre("render --scene a", "render"));
}

// Every group of the plan, quick and complete, has a valid file name and something to measure.
TEST(Plan, IsWhole) {
    BenchSettings near;
    near.viewDistance = near.farthest = 1;
    for (const BenchSettings& settings : {BenchSettings(), quickSettings(), near}) {
        std::set<std::string> names;
        for (const CellGroup& group : planGroups(settings)) {
            EXPECT_TRUE(names.insert(group.name).second) << group.name;
            EXPECT_EQ(group.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos);
            EXPECT_FALSE(group.cells.empty()) << group.name;
            for (const Cell& cell : group.cells) EXPECT_FALSE(cell.arguments.empty()) << group.name;
        }
    }
}

// A run that reads a save has a run before it that fills the save.
TEST(Plan, FillsSavesBefore) {
    for (const Cell& cell : uniqueCells(planGroups({}))) {
        EXPECT_EQ(cell.before.empty(), keyOf(cell).find("--world") == std::string::npos) << keyOf(cell);
    }
}

// --quick has far fewer measurements.
TEST(Plan, QuickIsMuchLess) {
    const std::size_t quick = uniqueCells(planGroups(quickSettings())).size();
    EXPECT_LT(quick, 130u);
    EXPECT_GT(uniqueCells(planGroups({})).size(), quick * 5 / 4);
}

}  // namespace
}  // namespace terrane::app
