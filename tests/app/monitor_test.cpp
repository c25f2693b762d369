#include <gtest/gtest.h>

#include "apps/terrane/window/window.h"

namespace terrane::app {
namespace {

constexpr ScreenArea kFirst{{0, 0}, {1920, 1080}}, kRight{{1920, 0}, {2560, 1440}},
    kLeft{{-1280, -200}, {1280, 1024}}, kAbove{{0, -1080}, {1920, 1080}};

std::size_t monitorAt(glm::ivec2 corner, glm::ivec2 size, const std::vector<ScreenArea>& monitors) {
    return monitorOf({corner, size}, monitors);
}

TEST(Monitor, IsTheOneThatTheWindowIsOn) {
    const std::vector<ScreenArea> all = {kFirst, kRight, kLeft, kAbove};
    EXPECT_EQ(monitorAt({100, 100}, {1280, 720}, all), 0u);
    EXPECT_EQ(monitorAt({2000, 300}, {1280, 720}, all), 1u);
    EXPECT_EQ(monitorAt({-1200, -100}, {800, 600}, all), 2u);
    EXPECT_EQ(monitorAt({300, -900}, {800, 600}, all), 3u);
}

TEST(Monitor, HasTheLargestPartOfTheWindow) {
    const std::vector<ScreenArea> all = {kFirst, kRight, kLeft};
    EXPECT_EQ(monitorAt({1920 - 500, 0}, {1000 - 1, 600}, all), 0u);
    EXPECT_EQ(monitorAt({1920 - 500, 0}, {1000 + 1, 600}, all), 1u);
    EXPECT_EQ(monitorAt({-501, 0}, {1000, 600}, all), 2u);
    EXPECT_EQ(monitorAt({-5000, -5000}, {20000, 20000}, all), 1u) << "it covers all: the largest";
}

TEST(Monitor, IsTheFirstOfEqualsAndOfNone) {
    EXPECT_EQ(monitorAt({1920 - 500, 0}, {1000, 600}, {kFirst, kRight}), 0u);
    EXPECT_EQ(monitorAt({1920 - 500, 0}, {1000, 600}, {kRight, kFirst}), 0u);
    EXPECT_EQ(monitorAt({9000, 9000}, {800, 600}, {kFirst, kRight}), 0u) << "on none";
    EXPECT_EQ(monitorAt({1920, 0}, {0, 0}, {kFirst, kRight}), 0u) << "it has no size";
    EXPECT_EQ(monitorAt({0, 0}, {800, 600}, {}), 0u) << "there is none";
    EXPECT_EQ(monitorAt({2147483000, 0}, {600, 600}, {kFirst, {{2147480000, 0}, {3600, 2000}}}), 1u);
}

}  // namespace
}  // namespace terrane::app
