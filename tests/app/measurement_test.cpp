#include "apps/terrane/bench/measurement.h"

#include <gtest/gtest.h>

#include "apps/terrane/median.h"

namespace terrane::app {
namespace {

using nlohmann::json;

TEST(Median, IsTheMiddle) {
    EXPECT_EQ(medianOf(std::vector{7.0}), 7);
    EXPECT_EQ(medianOf(std::vector{9.0, 1.0, 2.0}), 2);
    EXPECT_EQ(medianOf(std::vector{4.0, 100.0, 1.0, 2.0}), 3);
}

TEST(Median, OfRunsIsTakenNumberByNumber) {
    const std::vector<json> runs = {
        {{"frame", 30}, {"passes", {{"sky", 1}, {"shade", 5}}}, {"file", "a.png"}},
        {{"frame", 10}, {"passes", {{"sky", 9}, {"shade", 7}}}, {"file", "b.png"}},
        {{"frame", 20}, {"passes", {{"sky", 4}, {"shade", 6}}}, {"file", "c.png"}},
    };
    const json median = medianOf(runs);
    EXPECT_EQ(median["frame"], 20);
    EXPECT_EQ(median["passes"]["sky"], 4);
    EXPECT_EQ(median["passes"]["shade"], 6);
    EXPECT_EQ(median["file"], "a.png");
}

TEST(Median, OfRunsTakesWhatOnlySomeHave) {
    const std::vector<json> runs = {{{"a", 1}}, {{"a", 3}, {"b", 8}}, {{"b", "text"}, {"a", 2}}};
    const json median = medianOf(runs);
    EXPECT_EQ(median["a"], 2);
    EXPECT_EQ(median["b"], 8);
}

TEST(Value, IsWhereThePointerSays) {
    const json measurement = {{"milliseconds", {{"frame", 20}}}, {"chunks", 50}, {"file", "a"}};
    EXPECT_EQ(valueIn(measurement, {"/milliseconds/frame"}), 20);
    EXPECT_EQ(valueIn(measurement, {"/milliseconds/frame", 0.5}), 10);
    EXPECT_EQ(valueIn(measurement, {"/milliseconds/frame", 1000, true}), 50);
    EXPECT_EQ(valueIn(measurement, {"/milliseconds/frame", 10, false, "/chunks"}), 4);
    EXPECT_EQ(valueIn(measurement, {"/milliseconds/frame", 10, true, "/chunks"}), 25);
}

TEST(Value, IsNoneWhereItCannotBe) {
    const json measurement = {{"zero", 0}, {"one", 1}, {"file", "a"}};
    EXPECT_EQ(valueIn(measurement, {"/two"}), std::nullopt);
    EXPECT_EQ(valueIn(measurement, {"/one/more"}), std::nullopt);
    EXPECT_EQ(valueIn(measurement, {"/file"}), std::nullopt);
    EXPECT_EQ(valueIn(measurement, {"/zero", 1, true}), std::nullopt);
    EXPECT_EQ(valueIn(measurement, {"/one", 1, false, "/zero"}), std::nullopt);
    EXPECT_EQ(valueIn(measurement, {"/one", 1, false, "/two"}), std::nullopt);
}

TEST(Measurements, FindByArguments) {
    Measurements measured;
    measured.runs["render --scene cave"] = {{{"a", 1}}, {{"a", 2}}, {{"a", 9}}};
    measured.failures["render"] = "no";
    EXPECT_EQ((*measured.find({{"render", "--scene", "cave"}, {"before"}}))["a"], 2);
    EXPECT_EQ(measured.find({{"render"}}), std::nullopt);
    EXPECT_EQ(measured.failureOf({{"render"}}), "no");
    EXPECT_EQ(measured.failureOf({{"render", "--scene", "cave"}}), "");
}

}  // namespace
}  // namespace terrane::app
