#include "terrane/web/metrics.h"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

namespace terrane::web {
namespace {

TEST(MetricsText, EachMetricHasHelpTypeAndValue) {
    MetricsText text;
    text.counter("made_total", "Things made.", 3);
    text.gauge("memory_bytes", "Memory.", 1e6);
    EXPECT_EQ(text.text(),
              "# HELP made_total Things made.\n# TYPE made_total counter\nmade_total 3\n"
              "# HELP memory_bytes Memory.\n# TYPE memory_bytes gauge\nmemory_bytes 1000000\n");
}

TEST(MetricsText, SamplesHaveLabels) {
    MetricsText text;
    text.begin("answers_total", "Answers.", "counter");
    text.sample("answers_total", "code=\"2xx\"", 7);
    text.sample("answers_total", "code=\"4xx\"", 0);
    EXPECT_EQ(text.text(),
              "# HELP answers_total Answers.\n# TYPE answers_total counter\n"
              "answers_total{code=\"2xx\"} 7\nanswers_total{code=\"4xx\"} 0\n");
}

// A number in Prometheus' format, as accepted by Go's ParseFloat.
TEST(MetricsText, AnyValueIsANumber) {
    MetricsText text;
    for (const double value : {0.0, -1.5, 0.1, 1e-9, 123456789.0, 9007199254740992.0, 1.5e300})
        text.gauge("value", "Any.", value);
    const std::regex line("value -?[0-9]+(\\.[0-9]+)?(e[+-]?[0-9]+)?");
    std::istringstream lines(text.text());
    int count = 0;
    for (std::string each; std::getline(lines, each);) {
        if (each.starts_with('#')) continue;
        EXPECT_TRUE(std::regex_match(each, line)) << each;
        ++count;
    }
    EXPECT_EQ(count, 7);
}

TEST(MetricsText, HistogramsCountUpToEachBound) {
    Histogram histogram({0.5, 1, 2});
    for (const double value : {0.1, 0.5, 0.75, 2.0, 50.0}) histogram.add(value);
    MetricsText text;
    text.histogram("tick_seconds", "Ticks.", histogram);
    EXPECT_EQ(text.text(),
              "# HELP tick_seconds Ticks.\n# TYPE tick_seconds histogram\n"
              "tick_seconds_bucket{le=\"0.5\"} 2\ntick_seconds_bucket{le=\"1\"} 3\n"
              "tick_seconds_bucket{le=\"2\"} 4\ntick_seconds_bucket{le=\"+Inf\"} 5\n"
              "tick_seconds_sum 53.35\ntick_seconds_count 5\n");
}

}  // namespace
}  // namespace terrane::web
