#include "terrane/net/client/client_packs.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"
#include "tests/pack/pack_fixture.h"

namespace terrane::net {
namespace {

class ClientPacksTest : public testing::Test {
  protected:
    void SetUp() override {
        auto content = pack::loadContent({pack::packOfFiles(pack::glowFiles("isles"))}).value();
        auto offered = serverContent(content);
        ASSERT_TRUE(offered) << offered.error().message;
        ASSERT_EQ(offered->packs.size(), 1u);
        archive_ = offered->packs[0].archive;
        offer_.packs = {offered->packs[0].offer};
    }
    ClientPacks packsThatAccept(const std::filesystem::path& cache = {}) const {
        return {.cache = cache, .acceptsAll = true, .accepted = {}, .packs = {}, .missing = {}};
    }

    std::shared_ptr<const Bytes> archive_;
    WorldOffer offer_;
};

TEST_F(ClientPacksTest, ThePlayerHasToAcceptThem) {
    ClientPacks packs = packsThatAccept();
    packs.acceptsAll = false;
    EXPECT_FALSE(missingPacks(packs, offer_));
    ASSERT_EQ(packs.missing, offer_.packs);
    EXPECT_TRUE(textOf(packs.missing).starts_with("isles 1.2 (")) << textOf(packs.missing);
    packs.accepted = {offer_.packs[0].hash};
    const auto missing = missingPacks(packs, offer_);
    ASSERT_TRUE(missing) << missing.error().message;
    EXPECT_EQ(*missing, std::vector<std::uint8_t>{0});
}

TEST_F(ClientPacksTest, GiveTheBlocksOfTheServer) {
    ClientPacks packs = packsThatAccept();
    EXPECT_FALSE(contentOf(packs, offer_));
    const auto taken = takePack(packs, offer_.packs[0], *archive_);
    ASSERT_TRUE(taken) << taken.error().message;
    const auto missing = missingPacks(packs, offer_);
    ASSERT_TRUE(missing) << missing.error().message;
    EXPECT_TRUE(missing->empty());
    const auto content = contentOf(packs, offer_);
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_NE(content->blocks->find("isles:glow"), nullptr);
}

TEST_F(ClientPacksTest, AnotherPackThanTheOfferedOneIsRefused) {
    ClientPacks packs = packsThatAccept();
    offer_.packs[0].hash[0] ^= std::byte{1};
    EXPECT_FALSE(takePack(packs, offer_.packs[0], *archive_));
    EXPECT_TRUE(packs.packs.empty());
}

TEST_F(ClientPacksTest, TheCacheKeepsThem) {
    const base::TempFolder folder;
    ClientPacks first = packsThatAccept(folder / "cache"), second = packsThatAccept(folder / "cache");
    ASSERT_TRUE(takePack(first, offer_.packs[0], *archive_));
    const auto missing = missingPacks(second, offer_);
    ASSERT_TRUE(missing) << missing.error().message;
    EXPECT_TRUE(missing->empty());
}

// A date of the future does not make an old file the last one used.
TEST_F(ClientPacksTest, TheCacheKeepsWhatWasUsedLast) {
    const base::TempFolder folder;
    const std::filesystem::path cache = folder / "cache", old = cache / "old";
    std::filesystem::create_directories(cache);
    ASSERT_TRUE(base::writeFile(old, ""));
    std::filesystem::resize_file(old, std::uintmax_t{600} << 20);  // sparse, more than a cache may have
    std::filesystem::last_write_time(
        old, std::filesystem::file_time_type::clock::now() + std::chrono::hours(24 * 365));
    ClientPacks first = packsThatAccept(cache), second = packsThatAccept(cache);
    ASSERT_TRUE(takePack(first, offer_.packs[0], *archive_));
    EXPECT_FALSE(std::filesystem::exists(old));
    const auto missing = missingPacks(second, offer_);
    ASSERT_TRUE(missing) << missing.error().message;
    EXPECT_TRUE(missing->empty());
}

}  // namespace
}  // namespace terrane::net
