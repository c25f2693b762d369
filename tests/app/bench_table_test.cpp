#include "apps/terrane/bench/bench_table.h"

#include <gmock/gmock.h>

#include <set>

#include "apps/terrane/bench/bench_plan.h"
#include "apps/terrane/bench/bench_report.h"
#include "apps/terrane/bench/plot.h"

namespace terrane::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Cell cellOf(const std::string& scene) {
    return {{"render", scene}};
}

Measurements twoScenes() {
    Measurements measured;
    measured.runs["render cave"] = {{{"frame", 20}, {"chunks", 100}, {"bytes", 5000}}};
    measured.runs["render ocean"] = {{{"frame", 50}, {"chunks", 300}, {"bytes", 9000}}};
    measured.failures["render desert"] = "exit code 2: no sand";
    return measured;
}

Table sceneTable() {
    Table table{"scenes", "Scenes", "About.", "cut", {"scene", "ms", "thesis"}};
    for (const char* scene : {"cave", "ocean", "desert"})
        table.rows.push_back({textEntry(scene), valueEntry(cellOf(scene), {"/frame"}), figureEntry(7)});
    return table;
}

TEST(FormatFigure, HasThreeDigitsAndMore) {
    EXPECT_EQ(formatFigure(0), "0");
    EXPECT_EQ(formatFigure(7), "7");
    EXPECT_EQ(formatFigure(0.000044), "< 0.001");
    EXPECT_EQ(formatFigure(-70), "-70");
    EXPECT_EQ(formatFigure(0.0123456), "0.0123");
    EXPECT_EQ(formatFigure(1.2345), "1.23");
    EXPECT_EQ(formatFigure(9.996), "10.0");
    EXPECT_EQ(formatFigure(12.345), "12.3");
    EXPECT_EQ(formatFigure(99.96), "100");
    EXPECT_EQ(formatFigure(999.4), "999");
    EXPECT_EQ(formatFigure(1234), "1,234");
    EXPECT_EQ(formatFigure(123456.7), "123,457");
    EXPECT_EQ(formatFigure(1234567), "1,234,567");
    EXPECT_EQ(formatFigure(-1234), "-1,234");
    EXPECT_EQ(formatFigure(-123), "-123");
}

TEST(Entry, Share) {
    EXPECT_EQ(numberOf(shareEntry(cellOf("cave"), cellOf("ocean"), {"/frame"}), twoScenes()), 40);
    EXPECT_EQ(numberOf(shareEntry(cellOf("cave"), cellOf("desert"), {"/frame"}), twoScenes()), std::nullopt);
}

TEST(Entry, DifferenceAndSum) {
    EXPECT_EQ(numberOf(differenceEntry(cellOf("ocean"), cellOf("cave"), {"/frame"}), twoScenes()), 30);
    EXPECT_EQ(numberOf(sumEntry(cellOf("cave"), {{"/frame"}, {"/chunks", 2}}), twoScenes()), 220);
    EXPECT_EQ(numberOf(sumEntry(cellOf("cave"), {{"/frame"}, {"/none"}}), twoScenes()), std::nullopt);
}

TEST(Entry, LineThroughMeasurements) {
    const std::vector<Cell> cells = {cellOf("cave"), cellOf("ocean")};
    // (100, 5000) and (300, 9000)
    EXPECT_EQ(numberOf(lineEntry(cells, {"/chunks"}, {{"/bytes"}}, LinePart::Slope), twoScenes()), 20);
    EXPECT_EQ(numberOf(lineEntry(cells, {"/chunks"}, {{"/bytes"}}, LinePart::Intercept), twoScenes()), 3000);
    EXPECT_EQ(numberOf(lineEntry(cells, {"/chunks"}, {{"/bytes"}, {"/bytes"}}, LinePart::Slope), twoScenes()),
              40);
    EXPECT_EQ(numberOf(lineEntry({cellOf("cave")}, {"/chunks"}, {{"/bytes"}}, LinePart::Slope), twoScenes()),
              std::nullopt);
}

TEST(BenchTable, NeedsEachCellOnce) {
    Table table = sceneTable();
    table.rows.push_back(
        {textEntry("all"), shareEntry(cellOf("cave"), cellOf("forest"), {"/frame"}), textEntry("")});
    table.curvePlot = CurvePlot{"x", "y", "", {{cellOf("sky"), "/x", "/y", "sky"}}};
    std::vector<std::string> keys;
    for (const Cell& cell : cellsOf(table)) keys.push_back(keyOf(cell));
    EXPECT_THAT(keys, testing::ElementsAre("render cave", "render ocean", "render desert", "render forest",
                                           "render sky"));
}

TEST(BenchTable, Markdown) {
    EXPECT_EQ(markdownOf(sceneTable(), twoScenes()),
              "| scene | ms | thesis |\n"
              "|---|---|---|\n"
              "| cave | 20 | 7 |\n"
              "| ocean | 50 | 7 |\n"
              "| desert | failed | 7 |\n");
}

TEST(BenchTable, MarkdownOfAMissingValueAndOfABar) {
    Table table{"t", "T", "", "", {"a|b", "ms"}};
    table.rows = {{textEntry("x|y"), valueEntry(cellOf("cave"), {"/none"})}};
    EXPECT_EQ(markdownOf(table, twoScenes()), "| a\\|b | ms |\n|---|---|\n| x\\|y | – |\n");
}

TEST(BenchTable, CsvQuotesWhatItMust) {
    Table table{"t", "T", "", "", {"scene, \"name\"", "ms"}};
    table.rows = {{textEntry("a,b"), valueEntry(cellOf("cave"), {"/frame", 1.0 / 3})},
                  {textEntry("plain"), valueEntry(cellOf("desert"), {"/frame"})}};
    EXPECT_EQ(csvOf(table, twoScenes()), "\"scene, \"\"name\"\"\",ms\n\"a,b\",6.66666667\nplain,\n");
}

TEST(BenchTable, FailuresAreNamed) {
    EXPECT_EQ(failuresOf(sceneTable(), twoScenes()), "- `render desert`: exit code 2: no sand\n");
}

TEST(Plots, OfBarsHaveTheNumbersOfTheTable) {
    const Plot plot{"", PlotKind::Bars, "scene", "ms", {1, 2}, 1};
    const std::string script = plotScript(sceneTable(), plot, twoScenes(), "/out/it's.svg");
    EXPECT_THAT(script, HasSubstr("\"cave\" 20 7\n\"ocean\" 50 7\n\"desert\" NaN 7\n"));
    EXPECT_THAT(script, HasSubstr("set output '/out/it''s.svg'"));
    EXPECT_THAT(script, HasSubstr("title 'thesis'"));
}

TEST(Plots, OfNothingAreNotDrawn) {
    const Plot plot{"", PlotKind::Bars, "scene", "ms", {1}, 1};
    EXPECT_THAT(plotScript(sceneTable(), plot, {}, "/a.svg"), IsEmpty());
}

TEST(Plots, OfCurvesTakeArrays) {
    Measurements measured;
    measured.runs["render cave"] = {{{"t", {0, 1}}, {"n", {10, 30}}}};
    Table table = sceneTable();
    table.curvePlot = CurvePlot{
        "s", "n", "right", {{cellOf("cave"), "/t", "/n", "a", true}, {cellOf("ocean"), "/t", "/n", "b"}}};
    const std::string script = curveScript(table, measured, "/a.svg");
    EXPECT_THAT(script, HasSubstr("0 10\n1 30\n"));
    EXPECT_THAT(script, HasSubstr("axes x1y2"));
    EXPECT_THAT(script, Not(HasSubstr("title 'b'")));
}

// Every table of the plan, quick and whole: as many entries as columns, names that can be files, plots of
// columns that are there.
TEST(Plan, IsWhole) {
    BenchSettings near;
    near.viewDistance = near.farthest = 1;
    for (const BenchSettings& settings : {BenchSettings(), quickSettings(), near}) {
        std::set<std::string> names;
        for (const Table& table : planTables(settings)) {
            EXPECT_TRUE(names.insert(table.name).second) << table.name;
            EXPECT_EQ(table.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos);
            EXPECT_FALSE(table.title.empty() || table.about.empty() || table.cut.empty()) << table.name;
            EXPECT_FALSE(table.rows.empty()) << table.name;
            EXPECT_FALSE(cellsOf(table).empty()) << table.name;
            for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
            for (const Plot& plot : table.plots)
                for (const std::size_t column : plot.columns) EXPECT_LT(column, table.columns.size());
        }
    }
}

// What --quick leaves out is left out.
TEST(Plan, QuickIsMuchLess) {
    const auto count = [](const BenchSettings& settings) {
        std::set<std::string> keys;
        for (const Table& table : planTables(settings))
            for (const Cell& cell : cellsOf(table)) keys.insert(keyOf(cell));
        return keys.size();
    };
    EXPECT_LT(count(quickSettings()), 130u);
    EXPECT_GT(count(BenchSettings()), count(quickSettings()) * 5 / 4);
}

}  // namespace
}  // namespace terrane::app
