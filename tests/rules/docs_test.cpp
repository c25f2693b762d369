// The code of docs/scripting.md and docs/start/rules.md runs, and the reference names all functions.
#include <filesystem>
#include <regex>

#include "terrane/base/files.h"
#include "tests/rules/rules_fixture.h"

namespace terrane::rules {
namespace {

std::string pageOf(const char* name) {
    const auto text = base::readFile(std::filesystem::path(TERRANE_SOURCE_DIR) / "docs" / name);
    EXPECT_TRUE(text) << name;
    return text.value_or("");
}

std::vector<std::string> codeOf(const char* name) {
    const std::string page = pageOf(name), begin = "```lua\n";
    std::vector<std::string> blocks;
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
        at += begin.size();
        blocks.push_back(page.substr(at, page.find("```", at) - at));
    }
    return blocks;
}

class RulesDocs : public RulesTest {};

TEST_F(RulesDocs, CodeRuns) {
    for (const char* page : {"scripting.md", "start/rules.md"}) {
        const std::vector<std::string> blocks = codeOf(page);
        EXPECT_FALSE(blocks.empty());
        for (const std::string& code : blocks) {
            run(code);
            session_.edit(
                {game::kNoPlayer, ground_, world::SetBlock{contentBlock("gold_ore")}, std::nullopt});
            set(ground_, "air");
            tick(2);
            EXPECT_THAT(problems(), testing::IsEmpty()) << code;
        }
    }
}

TEST_F(RulesDocs, TheGoldRuleIsShort) {
    const std::string rule = codeOf("start/rules.md").at(0);
    EXPECT_LE(std::ranges::count(rule, '\n'), 10);
    run(rule);
    session_.edit({game::kNoPlayer, ground_, world::SetBlock{contentBlock("gold_ore")}, std::nullopt});
    set(ground_, "air");
    EXPECT_THAT(lines_, testing::ElementsAre("Ann found gold!"));
    EXPECT_EQ(world::countItems(session_.itemsOf(game::kLocalPlayer).slots, "torch"), 5);
}

TEST_F(RulesDocs, TheRaceIsPlayed) {
    run(codeOf("start/rules.md").at(2));
    EXPECT_THAT(lines_, testing::ElementsAre("/race hides gold, /score shows the points"));
    EXPECT_EQ(set(above_, "gold_ore"), game::EditResult::Refused);
    EXPECT_TRUE(game::runChatCommand(session_, game::kLocalPlayer, "race"));
    std::vector<world::BlockPos> gold;
    for (int x = -8; x < 20; ++x)
        for (int y = -8; y < 20; ++y)
            if (at({x, y, game::kGroundHeight - 1}) == "gold_ore")
                gold.push_back({x, y, game::kGroundHeight - 1});
    ASSERT_FALSE(gold.empty());
    session_.setPlayer(game::kLocalPlayer,
                       {.position = {gold[0].x + 0.5, gold[0].y + 0.5, game::kGroundHeight + 2.0}});
    EXPECT_EQ(set(gold[0], "air"), game::EditResult::Applied);
    EXPECT_TRUE(game::runChatCommand(session_, game::kLocalPlayer, "score"));
    EXPECT_EQ(lines_.back(), "Ann 1");
    tick(2401);
    EXPECT_EQ(lines_.back(), "the race is over");
    EXPECT_THAT(problems(), testing::IsEmpty());
}

TEST(RuleNames, TheReferenceHasAll) {
    const std::string page = pageOf("scripting.md") + pageOf("lua.md");
    const std::vector<std::string> names = ruleFunctions();
    EXPECT_GT(names.size(), 70u);
    for (const std::string& name : names) {
        const std::size_t start = name.find_last_of(".:");
        const std::string word = start == std::string::npos ? name : name.substr(start + 1);
        EXPECT_TRUE(std::regex_search(page, std::regex("\\b" + word + "\\b"))) << name;
    }
    for (const char* call : {"world.fill", "storage.get", "players.all", "chat.say", "commands.add"})
        EXPECT_EQ(std::ranges::count(names, call), 1) << call;
}

}  // namespace
}  // namespace terrane::rules
