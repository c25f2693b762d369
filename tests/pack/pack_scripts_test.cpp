// Scripts of rules in packs: their version, and what clients of servers get.
#include <gtest/gtest.h>

#include "terrane/pack/pack_files.h"
#include "tests/pack/pack_fixture.h"

namespace terrane::pack {
namespace {

constexpr const char* kInfo = "format = 1\nname = \"isles\"\n";

std::string mistakeOf(const std::string& info) {
    const auto pack = makePack({{"pack.toml", info}, {"scripts/a.lua", ""}}, "isles");
    return pack ? "" : pack.error().message;
}

TEST(PackScripts, NeedAVersionThatIsKnown) {
    EXPECT_TRUE(isPackPath("scripts/gold.lua"));
    EXPECT_FALSE(isPackPath("scripts/Gold.lua"));
    EXPECT_EQ(mistakeOf(std::string(kInfo) + "rules = 1\n"), "");
    EXPECT_EQ(mistakeOf(kInfo), "isles/pack.toml: scripts/a.lua needs rules = 1 in this file");
    EXPECT_EQ(
        mistakeOf(std::string(kInfo) + "rules = 2\n"),
        "isles/pack.toml:3: rules: expected 1, the version of this program's interface for rules, got 2");
    EXPECT_NE(mistakeOf(std::string(kInfo) + "rules = \"1\"\n").find("isles/pack.toml:3: rules"),
              std::string::npos);
    PackFiles many = {{"pack.toml", std::string(kInfo) + "rules = 1"}};
    for (std::size_t k = 0; k <= kMaxRuleScripts; ++k)
        many.emplace("scripts/a" + std::to_string(k) + ".lua", "");
    EXPECT_EQ(makePack(many, "isles").error().message, "isles: more than 64 scripts");
}

TEST(PackScripts, AreNotSentToClients) {
    const std::string info = std::string(kInfo) + "rules = 1  # scripts\nversion = \"2\"\n";
    const PackFiles without = {{"pack.toml", std::string(kInfo) + "version = \"2\"\n"}, {"blocks.toml", ""}};
    PackFiles with = without;
    with["pack.toml"] = info;
    with["scripts/a.lua"] = "x = 1";
    EXPECT_EQ(clientFiles(with), without);
    EXPECT_EQ(clientFiles(without), without);
    const Pack pack = makePack(with, "isles").value();
    EXPECT_EQ(hashOf(pack), hashOf(makePack(without, "isles").value()));
    EXPECT_EQ(packOf(archiveOf(pack), "server").value().files, without);
}

}  // namespace
}  // namespace terrane::pack
