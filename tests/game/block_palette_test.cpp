#include "terrane/game/items.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/content_blocks.h"

namespace terrane::game {
namespace {

std::string typeName(world::BlockId block) {
    return contentBlocks().type(block).name;
}

std::vector<std::string> namesOf(std::string_view group, std::string_view search) {
    std::vector<std::string> names;
    for (const world::BlockId block : paletteBlocks(contentBlocks(), {group, search, typeName}))
        names.push_back(typeName(block));
    return names;
}

TEST(BlockPalette, HasEachBlockThatIsBuiltOnce) {
    std::size_t built = 0, listed = 0;
    for (const world::BlockType& type : contentBlocks().types()) built += isBuildable(type, contentBlocks());
    for (const std::string& group : paletteGroups(contentBlocks())) listed += namesOf(group, "").size();
    EXPECT_EQ(namesOf("", "").size(), built);
    EXPECT_EQ(listed, built) << "each block is in one group";
    EXPECT_GE(paletteGroups(contentBlocks()).size(), 5u);
}

TEST(BlockPalette, EachWordOfASearchIsInTheName) {
    const auto names = namesOf("", " Slab  oAk ");
    EXPECT_EQ(names, std::vector<std::string>{"oak_slab"});
    EXPECT_TRUE(namesOf("", "oak nothing").empty());
    EXPECT_TRUE(namesOf("no such group", "").empty());
}

TEST(BlockPalette, ShownNamesAreSearchedToo) {
    const auto czech = [](world::BlockId block) {
        return std::string(typeName(block) == "torch" ? "Pochodeň" : "x");
    };
    const auto found = paletteBlocks(contentBlocks(), {"", "pocho", czech});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front(), contentBlock("torch"));
}

TEST(BlockPalette, NamesThatBeginWithTheSearchComeFirst) {
    const auto names = namesOf("", "glass");
    ASSERT_GE(names.size(), 2u);
    EXPECT_EQ(names.front(), "glass");
    EXPECT_NE(std::ranges::find(names, "red_glass"), names.end());
}

}  // namespace
}  // namespace terrane::game
