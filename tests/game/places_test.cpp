#include "terrane/game/places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrane/store/overlay_store.h"

namespace terrane::game {
namespace {

const world::Pose kPose{{1.5, -2, 80.25}, 30, -5}, kOther{{100, 200, 70}, -90, 0};

TEST(Places, ComeBackFromTheWorld) {
    store::MemoryStore store({1, "flat", 1});
    EXPECT_TRUE(savedPlaces(store).empty());
    std::vector<Place> places;
    EXPECT_TRUE(namePlace(places, "  Můj dům ", kPose));
    EXPECT_TRUE(namePlace(places, "mine 2", kOther));
    savePlaces(store, places);
    EXPECT_EQ(savedPlaces(store), places);
    EXPECT_EQ(places[0].name, "Můj dům");
}

TEST(Places, ANameIsThereOnce) {
    std::vector<Place> places;
    EXPECT_TRUE(namePlace(places, "home", kPose));
    EXPECT_TRUE(namePlace(places, "home", kOther));
    ASSERT_EQ(places.size(), 1u);
    EXPECT_EQ(places[0].pose, kOther);
    EXPECT_FALSE(namePlace(places, " \n\t", kPose));
}

TEST(Places, DistancesCountHeight) {
    EXPECT_DOUBLE_EQ(distanceBetween({{1, 2, -800}, 30, -5}, {{4, 6, 400}, 0, 0}), std::hypot(3, 4, 1200));
}

TEST(Places, NamesAreOneLineOfBoundedLength) {
    EXPECT_EQ(placeName("a\nb\x7f"), "a b");
    std::string czech;
    for (int k = 0; k < 50; ++k) czech += "č";
    EXPECT_EQ(placeName("x" + czech).size(), 59u) << "cut between characters of two bytes";
}

TEST(Places, NewNamesFollowTheRule) {
    std::vector<Place> places;
    ASSERT_TRUE(namePlace(places, "Mill", kPose));
    for (const char* bad : {"\u3164", "Mill\u200b", "mill", "Mi1l", "\u039cill", "\xff"})
        EXPECT_FALSE(namePlace(places, bad, kOther)) << bad;
    EXPECT_EQ(namePlace(places, "Mi1l", kOther).error().message,
              "the name Mi1l looks like that of the place Mill");
    EXPECT_EQ(places, (std::vector<Place>{{"Mill", kPose}}));
    EXPECT_TRUE(namePlace(places, "Cafe\u0301", kPose));
    EXPECT_TRUE(namePlace(places, "Café", kOther)) << "the same name";
    EXPECT_EQ(places.size(), 2u);
}

// They were named before the rule.
TEST(Places, OldNamesStay) {
    std::vector<Place> places = placesFrom("1 2 70 0 0 Mill\u200b\n1 2 70 0 0 Mill\n");
    ASSERT_EQ(places.size(), 2u);
    EXPECT_TRUE(namePlace(places, "Mill\u200b", kOther)) << "it moves";
    EXPECT_EQ(places[0].pose, kOther);
    EXPECT_EQ(placesFrom(textOf(places)), places);
}

TEST(Places, ThereIsAMaximum) {
    std::vector<Place> places;
    for (std::size_t k = 0; k < kMaxPlaces; ++k) EXPECT_TRUE(namePlace(places, std::to_string(k), kPose));
    EXPECT_FALSE(namePlace(places, "one more", kPose));
    EXPECT_TRUE(namePlace(places, "7", kOther)) << "one that is there moves";
    EXPECT_EQ(placesFrom(textOf(places) + textOf(places)).size(), kMaxPlaces);
}

TEST(Places, LinesThatAreNoneAreLeftOut) {
    EXPECT_EQ(placesFrom("1 2 3\nnonsense\n1 2 3 4 5 here\n1 2 3 4 5\n1e99 0 0 0 0 far\n").size(), 1u);
}

TEST(Places, TheSunRisesInTheEast) {
    EXPECT_DOUBLE_EQ(compassDegrees(0.0, -1.0), 0);
    EXPECT_DOUBLE_EQ(compassDegrees(-1.0, 0.0), 90);
    EXPECT_DOUBLE_EQ(compassDegrees(0.0, 1.0), 180);
    EXPECT_DOUBLE_EQ(compassDegrees(1.0, 0.0), 270);
    EXPECT_NEAR(compassDegrees(90.0f), 180, 1e-9);
    EXPECT_NEAR(compassDegrees(180.0f), 90, 1e-9);
}

}  // namespace
}  // namespace terrane::game
