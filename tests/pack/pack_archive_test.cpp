#include "terrane/pack/pack_files.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/pack/pack_fixture.h"

namespace terrane::pack {
namespace {

TEST(PackArchive, BringsThePackBack) {
    const Pack pack = packOfFiles(glowFiles("isles"));
    const store::Bytes archive = archiveOf(pack);
    const Pack again = packOf(archive, "server").value();
    EXPECT_EQ(again.files, pack.files);
    EXPECT_EQ(again.info.name, "isles");
    EXPECT_EQ(hashOf(again), hashOf(pack));
    EXPECT_EQ(archiveOf(again), archive);
}

TEST(PackArchive, TheHashIsThatOfTheFiles) {
    const Pack pack = packOfFiles(glowFiles("isles"));
    PackFiles changed = glowFiles("isles");
    changed["blocks.toml"] += " ";
    EXPECT_NE(hashOf(packOfFiles(changed)), hashOf(pack));
    EXPECT_EQ(hashOf(packOfFiles(glowFiles("isles"), "elsewhere")), hashOf(pack));
    EXPECT_EQ(hexOf(hashOf(pack)).size(), 64u);
}

TEST(PackArchive, WhatIsNoneIsRefused) {
    const store::Bytes archive = archiveOf(packOfFiles(glowFiles("isles")));
    EXPECT_FALSE(packOf({}, "x"));
    for (std::size_t cut = 0; cut < archive.size(); cut += 7)
        EXPECT_FALSE(packOf(store::ByteView(archive).first(cut), "x")) << cut;
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        store::Bytes changed = archive;
        changed[random() % changed.size()] ^= static_cast<std::byte>(1 + random() % 255);
        const auto read = packOf(changed, "x");
        EXPECT_TRUE(!read || read->files.size() == 5);  // a bit of zstd's that means nothing
    }
}

// A header with a size of 4 GiB.
TEST(PackArchive, ClaimsOfSizeAreChecked) {
    store::Bytes archive = archiveOf(packOfFiles(glowFiles("isles")));
    for (int k = 4; k < 8; ++k) archive[static_cast<std::size_t>(k)] = std::byte{0xFF};
    const auto read = packOf(archive, "x");
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("more than 64 MiB"), std::string::npos) << read.error().message;
}

}  // namespace
}  // namespace terrane::pack
