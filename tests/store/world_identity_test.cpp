#include "terrane/store/saves/world_identity.h"

#include <gmock/gmock.h>

#include "terrane/base/digest.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using base::ErrorCode;
using testing::HasSubstr;

TEST(SeedFrom, ANegativeSeedIsTheSame64Bits) {
    EXPECT_EQ(seedFrom("0")->seed, 0u);
    EXPECT_EQ(seedFrom("-1")->seed, UINT64_MAX);
    EXPECT_EQ(seedFrom("-4172144997902289642")->seed, 14274599075807261974u);
    EXPECT_EQ(seedFrom("-9223372036854775808")->seed, std::uint64_t{1} << 63);
    EXPECT_EQ(seedFrom("18446744073709551615")->seed, UINT64_MAX);
    for (const char* number : {"-1", "12"}) EXPECT_EQ(seedFrom(number)->text, "");
    for (const char* bad : {"", "+1", "-9223372036854775809", "18446744073709551616"})
        EXPECT_FALSE(seedFrom(bad)) << bad;
    EXPECT_EQ(seedFrom("- 1")->text, "- 1");
}

TEST(SeedFrom, HashesOtherTexts) {
    for (const std::string text : {"my world", "7 ", "0x10", "1.5"}) {
        const auto seed = seedFrom(text);
        ASSERT_TRUE(seed) << text;
        EXPECT_EQ(seed->seed, base::hash64(text));
        EXPECT_EQ(seed->text, text);
    }
}

TEST(RequireSame, SaysHowTheyDiffer) {
    EXPECT_TRUE(requireSame(kIdentity, kIdentity, "a.sqlite"));
    WorldIdentity other = kIdentity;
    other.seed = 8;
    EXPECT_EQ(requireSame(kIdentity, other, "a.sqlite").error().message, "a.sqlite: made with seed 7, not 8");
    other = kIdentity;
    other.generator = "overworld";
    EXPECT_EQ(requireSame(kIdentity, other, "a.sqlite").error().message,
              "a.sqlite: made by the generator flat, not overworld");
    other = kIdentity;
    other.generatorVersion = 4;
    EXPECT_THAT(requireSame(kIdentity, other, "a.sqlite").error().message, HasSubstr("version 3"));
    other = kIdentity;
    other.heights = {-64, 320};
    EXPECT_EQ(requireSame(kIdentity, other, "a.sqlite").error().message,
              "a.sqlite: has the layers 0 to 255, not -64 to 319");
}

TEST(Metadata, HeightsAreWrittenOnlyIfTheyAreNotUsual) {
    EXPECT_EQ(metadataOf(kIdentity).size(), 3u);
    for (const world::Heights heights : {world::Heights{-64, 320}, {-2048, 2048}, {512, 1024}, {0, 16}}) {
        WorldIdentity tall = kIdentity;
        tall.heights = heights;
        const Metadata metadata = metadataOf(tall);
        EXPECT_EQ(metadata.at("bottom"), std::to_string(heights.bottom));
        EXPECT_EQ(metadata.at("top"), std::to_string(heights.top));
        EXPECT_EQ(identityFrom(metadata, "a").value(), tall);
    }
    EXPECT_TRUE(isReserved("bottom"));
    EXPECT_TRUE(isReserved("top"));
}

TEST(Metadata, WrongHeightsAreDamage) {
    const auto errorOf = [](const char* bottom, const char* top) {
        Metadata metadata = metadataOf(kIdentity);
        if (bottom) metadata["bottom"] = bottom;
        if (top) metadata["top"] = top;
        const auto identity = identityFrom(metadata, "a.sqlite");
        if (identity) return std::string();
        EXPECT_EQ(identity.error().code, ErrorCode::Damaged);
        EXPECT_EQ(identity.error().message.find('\n'), std::string::npos);
        return identity.error().message;
    };
    EXPECT_EQ(errorOf("-64", nullptr), "a.sqlite: damaged: the setting top is missing");
    EXPECT_EQ(errorOf(nullptr, "320"), "a.sqlite: damaged: the setting bottom is missing");
    EXPECT_THAT(errorOf("-64", "320 "), HasSubstr("the setting top is \"320 \", expected a number"));
    EXPECT_THAT(errorOf("99999999999", "320"), HasSubstr("expected a number"));
    for (const auto& [bottom, top] : {std::pair{"5", "320"},
                                      {"0", "0"},
                                      {"64", "0"},
                                      {"-2064", "0"},
                                      {"0", "2064"},
                                      {"-2147483648", "2147483647"}})
        EXPECT_THAT(errorOf(bottom, top), HasSubstr("a.sqlite: damaged: a world's bottom and top are"))
            << bottom << " " << top;
    EXPECT_EQ(errorOf("-64", "320"), "");
}

// A program with the generators flat, in this version, and overworld.
base::Result<Regeneration> compare(const RequestedWorld& requested, int flatVersion = 3) {
    const auto versionOf = [=](std::string_view generator) {
        return generator == "flat" ? flatVersion : generator == "overworld" ? 1 : 0;
    };
    return compareWorld(kIdentity, requested, versionOf, "a.sqlite");
}

TEST(CompareWorld, WhatIsNotGivenIsTaken) {
    for (const RequestedWorld& requested :
         {RequestedWorld{}, {.seed = 7, .generator = {}}, {.seed = {}, .generator = "flat"}}) {
        const auto by = compare(requested);
        ASSERT_TRUE(by) << by.error().message;
        EXPECT_EQ(by->chunks, Regenerate::None);
    }
}

TEST(CompareWorld, AnotherWorldIsRefused) {
    for (const Regenerate regenerate : {Regenerate::None, Regenerate::AllButEdited, Regenerate::All}) {
        const auto seed = compare({.seed = 8, .generator = {}, .regenerate = regenerate});
        ASSERT_FALSE(seed);
        EXPECT_EQ(seed.error().code, ErrorCode::Incompatible);
        EXPECT_THAT(seed.error().message, HasSubstr("seed 7, not 8"));
        EXPECT_THAT(compare({.seed = {}, .generator = "overworld", .regenerate = regenerate}).error().message,
                    HasSubstr("generator flat, not overworld"));
    }
}

TEST(CompareWorld, OtherHeightsAreRefused) {
    RequestedWorld requested;
    requested.heights = world::Heights();
    EXPECT_TRUE(compare(requested));
    requested.heights = world::Heights{0, 512};
    for (const Regenerate regenerate : {Regenerate::None, Regenerate::AllButEdited, Regenerate::All}) {
        requested.regenerate = regenerate;
        const auto by = compare(requested);
        ASSERT_FALSE(by);
        EXPECT_EQ(by.error().code, ErrorCode::Incompatible);
        EXPECT_EQ(by.error().message, "a.sqlite: has the layers 0 to 255, not 0 to 511");
    }
}

TEST(CompareWorld, AnotherVersionIsRefusedUnlessRegenerated) {
    EXPECT_THAT(compare({}, 5).error().message,
                HasSubstr("version 3 of the generator flat, this program has version 5"));
    EXPECT_THAT(compare({}, 5).error().message, HasSubstr("--regenerate keep-edits"));
    for (const Regenerate regenerate : {Regenerate::AllButEdited, Regenerate::All}) {
        for (const int version : {5, 3}) {  // a different version, then the same
            const auto by = compare({.seed = {}, .generator = {}, .regenerate = regenerate}, version);
            ASSERT_TRUE(by) << by.error().message;
            EXPECT_EQ(by->chunks, regenerate);
            EXPECT_EQ(by->generatorVersion, version);
        }
    }
    EXPECT_THAT(compare({}, 0).error().message,
                HasSubstr("generator flat, which this program does not have"));
}

// For the development of generators: only another version regenerates chunks, and no backup is kept.
TEST(CompareWorld, FollowsTheGeneratorWhereAsked) {
    const RequestedWorld follows{.seed = {}, .generator = {}, .followsGenerator = true};
    const auto same = compare(follows, 3);
    ASSERT_TRUE(same) << same.error().message;
    EXPECT_EQ(same->chunks, Regenerate::None);
    const auto other = compare(follows, 5);
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_EQ(other->chunks, Regenerate::AllButEdited);
    EXPECT_EQ(other->generatorVersion, 5);
    EXPECT_FALSE(other->keepsBackup);
    EXPECT_FALSE(compare({.seed = 8, .generator = {}, .followsGenerator = true}, 5));
    EXPECT_TRUE(compare({.seed = {}, .generator = {}, .regenerate = Regenerate::All}, 5)->keepsBackup);
}

}  // namespace
}  // namespace terrane::store
