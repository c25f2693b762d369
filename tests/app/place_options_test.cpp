#include "apps/terrane/graphics_options.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

const content::Scene kOtherwise{"", {{8, 8, 120}, 45, -5}, 0.4f};

TEST(PlaceOptions, WithoutAnyItIsThePlaceOtherwise) {
    const auto place = placeOf({}, kOtherwise);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->pose.position, kOtherwise.pose.position);
    EXPECT_EQ(place->pose.yaw, 45);
    EXPECT_EQ(place->pose.pitch, -5);
    EXPECT_EQ(place->timeDay, 0.4f);
}

TEST(PlaceOptions, EachOptionChangesItsOwn) {
    PlaceOptions options;
    options.at = {1, -2, 3.5};
    const auto moved = placeOf(options, kOtherwise);
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->pose.position, glm::dvec3(1, -2, 3.5));
    EXPECT_EQ(moved->pose.yaw, 45);
    EXPECT_EQ(moved->pose.pitch, -5);

    options.look = {190, -30};
    options.time = 0.9f;
    const auto turned = placeOf(options, kOtherwise);
    ASSERT_TRUE(turned);
    EXPECT_EQ(turned->pose.position, glm::dvec3(1, -2, 3.5));
    EXPECT_EQ(turned->pose.yaw, 190);
    EXPECT_EQ(turned->pose.pitch, -30);
    EXPECT_EQ(turned->timeDay, 0.9f);
}

TEST(PlaceOptions, TheSceneComesFirst) {
    PlaceOptions options;
    options.scene = &content::scenes().front();
    options.look = {10, 20};
    const auto place = placeOf(options, kOtherwise);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->pose.position, content::scenes().front().pose.position);
    EXPECT_EQ(place->pose.yaw, 10);
    EXPECT_EQ(place->timeDay, content::scenes().front().timeDay);
}

TEST(PlaceOptions, OutsideTheWorldIsAnError) {
    PlaceOptions options;
    options.at = {3e9, 0, 80};
    const auto place = placeOf(options, kOtherwise);
    ASSERT_FALSE(place);
    EXPECT_NE(place.error().message.find("outside the world"), std::string::npos) << place.error().message;
}

}  // namespace
}  // namespace terrane::app
