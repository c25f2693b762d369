#include "terrane/io/open_session.h"

#include <gtest/gtest.h>

#include "tests/io/flat_world.h"

namespace terrane::io {
namespace {

using store::WorldAccess;

TEST(OpenSession, WithoutAWorldEditsStayInMemory) {
    WorldOptions options = flatLand();
    options.seed = 5;
    const auto opened = openSessionParts(options, {}, WorldAccess::ReadWrite);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened->parts.store->identity().seed, 5u);
    EXPECT_EQ(opened->parts.threads, 2u);
    EXPECT_TRUE(opened->parts.storesGenerated);
}

TEST(OpenSession, AWorldKeepsItsSeedAndGenerator) {
    const base::TempFolder folder;
    WorldOptions made = flatLand();
    made.seed = 5;
    ASSERT_TRUE(openSessionParts(made, worldIn(folder), WorldAccess::ReadWrite));
    WorldOptions again;
    const auto opened = openSessionParts(again, worldIn(folder), WorldAccess::ReadOnly);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(again.seed, 5u);
    EXPECT_EQ(again.generator, "flat");
    WorldOptions other;
    other.seed = 6;
    EXPECT_FALSE(openSessionParts(other, worldIn(folder), WorldAccess::ReadOnly));
}

TEST(OpenSession, AWorldKeepsWhetherItStoresGeneratedChunks) {
    const base::TempFolder folder;
    WorldOptions options = flatLand();
    SaveOptions save = worldIn(folder);
    save.storeGenerated = false;
    ASSERT_TRUE(openSessionParts(options, save, WorldAccess::ReadWrite));
    const auto opened = openSessionParts(options, worldIn(folder), WorldAccess::ReadWrite);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_FALSE(opened->parts.storesGenerated);
}

TEST(OpenSession, WhatNeedsAWorldFailsWithoutOne) {
    const base::TempFolder folder;
    WorldOptions options = flatLand();
    EXPECT_FALSE(openSessionParts(options, worldIn(folder), WorldAccess::ReadOnly)) << "there is no file";
    SaveOptions save;
    save.regenerate = store::Regenerate::All;
    EXPECT_FALSE(openSessionParts(options, save, WorldAccess::ReadWrite));
    save = {};
    save.storeGenerated = true;
    EXPECT_FALSE(openSessionParts(options, save, WorldAccess::ReadWrite));
}

TEST(OpenSession, AnUnknownGeneratorMakesNoFile) {
    const base::TempFolder folder;
    WorldOptions options = flatLand();
    options.generator = "nowhere";
    EXPECT_FALSE(openSessionParts(options, worldIn(folder), WorldAccess::ReadWrite));
    EXPECT_FALSE(std::filesystem::exists(folder / "world.sqlite"));
}

TEST(ThreadCount, IsThatOfTheMachineUnlessGiven) {
    WorldOptions options;
    EXPECT_GE(threadCount(options), 1u);
    options.threads = 3;
    EXPECT_EQ(threadCount(options), 3u);
}

}  // namespace
}  // namespace terrane::io
