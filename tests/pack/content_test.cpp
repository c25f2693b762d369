#include "terrane/pack/content.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrane/content/built_in.h"
#include "terrane/gen/generator.h"
#include "terrane/world/changes/block_edit.h"
#include "terrane/world/world.h"
#include "tests/pack/pack_fixture.h"

namespace terrane::pack {
namespace {

using testing::HasSubstr;

std::string errorOf(PackFiles files) {
    auto pack = makePack(std::move(files), "p");
    if (!pack) return pack.error().message;
    auto content = loadContent({*pack});
    return content ? "none" : content.error().message;
}

std::string errorOfFile(const std::string& path, const std::string& text) {
    PackFiles files = glowFiles("isles");
    files[path] = text;
    return errorOf(files);
}

TEST(Content, WithoutPacksIsWhatComesWithTheProgram) {
    const Content content = loadContent({}).value();
    ASSERT_EQ(content.packs->size(), 1u);
    EXPECT_EQ(content.packs->front().info.name, kBuiltInPack);
    const auto builtIn = content::loadBlocks().value();
    ASSERT_EQ(content.blocks->types().size(), builtIn.types().size());
    for (const world::BlockType& type : builtIn.types())
        EXPECT_EQ(content.blocks->type(type.id).name, type.name);
    EXPECT_EQ(content.blocks->textures().size(), builtIn.textures().size());
    EXPECT_EQ(gen::namesOf(content.generators), gen::namesOf(gen::builtInGenerators()));
}

TEST(Content, BlocksOfAPackHaveItsName) {
    const Content content = loadContent({packOfFiles(glowFiles("isles"))}).value();
    const world::BlockType* glow = content.blocks->find("isles:glow");
    ASSERT_NE(glow, nullptr);
    EXPECT_EQ(glow->emission, (std::array<std::uint8_t, 3>{1, 2, 3}));
    EXPECT_EQ(content.blocks->find("glow"), nullptr);
    ASSERT_NE(content.blocks->find("isles:step"), nullptr);
    EXPECT_EQ(content.blocks->find("isles:step")->shape, world::Shape::Model);
    EXPECT_TRUE(content.textures("isles:glow"));
    EXPECT_TRUE(content.textures("stone"));
    EXPECT_FALSE(content.textures("glow"));
}

// Ids of built-in blocks do not depend on packs.
TEST(Content, BuiltInBlocksComeFirst) {
    const Content content = loadContent({packOfFiles(glowFiles("isles"))}).value();
    const auto builtIn = content::loadBlocks().value();
    for (const world::BlockType& type : builtIn.types().first(builtIn.missing()))
        EXPECT_EQ(content.blocks->type(type.id).name, type.name);
}

TEST(Content, TwoPacksMayUseTheSameNames) {
    const Content content = loadContent({packOfFiles(glowFiles("a")), packOfFiles(glowFiles("b"))}).value();
    ASSERT_NE(content.blocks->find("a:glow"), nullptr);
    ASSERT_NE(content.blocks->find("b:glow"), nullptr);
    EXPECT_NE(content.blocks->find("a:glow")->id, content.blocks->find("b:glow")->id);
    EXPECT_FALSE(loadContent({packOfFiles(glowFiles("a")), packOfFiles(glowFiles("a"))}));
}

TEST(Content, ScriptsBecomeGenerators) {
    const Content content = loadContent({packOfFiles(glowFiles("isles"))}).value();
    EXPECT_GT(gen::versionOf(content.generators, "isles:flat"), 0);
    auto graph = gen::makeGenerator("isles:flat", *content.blocks, 0, content.generators);
    ASSERT_TRUE(graph) << graph.error().message;
    const world::Chunk chunk = gen::Generator(std::move(*graph), 1).generate({0, 0});
    EXPECT_EQ(chunk.block(world::blockIndex(3, 4, 70)), content.blocks->find("isles:glow")->id);
    EXPECT_EQ(chunk.block(world::blockIndex(3, 4, 71)), world::kAir);
}

// Block ids change with other packs, the version must not.
TEST(Content, AGeneratorsVersionDoesNotDependOnOtherPacks) {
    const Content alone = loadContent({packOfFiles(glowFiles("isles"))}).value();
    const Content after = loadContent({packOfFiles(glowFiles("a")), packOfFiles(glowFiles("isles"))}).value();
    EXPECT_EQ(gen::versionOf(alone.generators, "isles:flat"), gen::versionOf(after.generators, "isles:flat"));
    EXPECT_NE(alone.blocks->find("isles:glow")->id, after.blocks->find("isles:glow")->id);
    PackFiles changed = glowFiles("isles");
    changed["generators/flat.lua"].replace(changed["generators/flat.lua"].find("70"), 2, "71");
    const Content other = loadContent({packOfFiles(changed)}).value();
    EXPECT_NE(gen::versionOf(alone.generators, "isles:flat"), gen::versionOf(other.generators, "isles:flat"));
}

TEST(Content, PacksWhoseNamesLookAlikeAreRefused) {
    const auto both = loadContent({packOfFiles(glowFiles("isles1")), packOfFiles(glowFiles("islesl"))});
    ASSERT_FALSE(both);
    EXPECT_EQ(both.error().message,
              "p/pack.toml: name: \"islesl\" looks like the name of the pack \"isles1\"");
}

TEST(Content, RequiredPacksComeFirst) {
    PackFiles needs = glowFiles("a");
    needs["pack.toml"] = infoOf("a", "requires = [\"b\"]\n");
    const Content content = loadContent({packOfFiles(needs), packOfFiles(glowFiles("b"))}).value();
    EXPECT_EQ((*content.packs)[1].info.name, "b");
    EXPECT_EQ((*content.packs)[2].info.name, "a");
    EXPECT_THAT(errorOf(needs), HasSubstr("p/pack.toml: requires: the pack \"b\" is not loaded"));
    PackFiles circle = glowFiles("b");
    circle["pack.toml"] = infoOf("b", "requires = [\"a\"]\n");
    const auto circular = loadContent({packOfFiles(needs), packOfFiles(circle)});
    ASSERT_FALSE(circular);
    EXPECT_THAT(circular.error().message, HasSubstr("circle"));
}

TEST(Content, ErrorsNameFileLineAndKey) {
    EXPECT_THAT(
        errorOfFile("blocks.toml", "[[block]]\nname = \"a\"\nshape = \"cube\"\ntexture = \"nothing\"\n"),
        HasSubstr("p/blocks.toml:1: texture: there is no textures/nothing.png"));
    EXPECT_THAT(
        errorOfFile("blocks.toml", "[[block]]\nname = \"a\"\nshape = \"ball\"\ntexture = \"stone\"\n"),
        HasSubstr("p/blocks.toml:3: shape: expected one of cube"));
    EXPECT_THAT(errorOfFile("pack.toml", "format = 2\nname = \"isles\"\n"),
                HasSubstr("p/pack.toml:1: format"));
    EXPECT_THAT(errorOfFile("pack.toml", "format = 1\nname = \"Is les\"\n"),
                HasSubstr("p/pack.toml:2: name"));
    EXPECT_THAT(errorOfFile("pack.toml", "format = 1\nname = \n"), HasSubstr("p/pack.toml:2: syntax"));
    EXPECT_THAT(
        errorOfFile("generators/flat.lua", "g:pass3D(\"a\", function(p)\n p:setBlock(p:block(\"no\"))\nend)"),
        HasSubstr("p/generators/flat.lua:2"));
    EXPECT_THAT(errorOfFile("textures/glow.png", "nothing"), HasSubstr("p/textures/glow.png"));
    EXPECT_THAT(errorOfFile("textures/glow.png", pngOf(16, 8)), HasSubstr("p/textures/glow.png: 16 × 8"));
    EXPECT_THAT(errorOf({{"blocks.toml", kGlowBlocks}}), HasSubstr("there is no pack.toml"));
}

TEST(Content, TheNamesOfBlocksComeFromThePack) {
    const Content content = loadContent({packOfFiles(glowFiles("isles"))}).value();
    content::Language german = content::loadLanguage("de").value();
    ASSERT_TRUE(addBlockNames(german, content, "de"));
    EXPECT_EQ(content::blockName(german, *content.blocks->find("isles:glow")), "Glowing thing");
    EXPECT_EQ(content::blockName(german, *content.blocks->find("isles:step")), "Step");
}

// Behaviors name the pack's own block.
TEST(Content, BehaviorsWithParametersActOnBlocksOfThePack) {
    PackFiles files = glowFiles("isles");
    files["blocks.toml"] += R"(
[[block]]
name = "switch"
shape = "cube"
texture = "stone"
behaviors = [{ name = "used_becomes", block = "glow" }, { name = "touched_becomes", by = "water", block = "step" }]
)";
    const Content content = loadContent({packOfFiles(files)}).value();
    world::World world;
    world.insert({0, 0}, std::make_shared<world::Chunk>());
    std::vector<world::BlockEdit> edits;
    const auto change = [&](world::BlockPos pos, const world::BlockChange& what) {
        world::applyChange(world, *content.blocks, pos, what, edits);
    };
    const auto idOf = [&](const char* name) { return content.blocks->find(name)->id; };
    change({4, 4, 40}, world::SetBlock{idOf("isles:switch")});
    change({4, 4, 40}, world::UseBlock{});
    EXPECT_EQ(world.block({4, 4, 40}), idOf("isles:glow"));
    change({8, 8, 40}, world::SetBlock{idOf("isles:switch")});
    change({9, 8, 40}, world::SetBlock{idOf("dirt")});
    EXPECT_EQ(world.block({8, 8, 40}), idOf("isles:switch"));
    change({8, 9, 40}, world::SetBlock{idOf("water")});
    EXPECT_EQ(world.block({8, 8, 40}), idOf("isles:step"));

    const auto wrong = [&](const std::string& behavior) {
        PackFiles changed = glowFiles("isles");
        changed["blocks.toml"] +=
            "[[block]]\nname = \"s\"\nshape = \"cube\"\ntexture = \"stone\"\nbehaviors = [" + behavior +
            "]\n";
        return errorOf(changed);
    };
    EXPECT_THAT(wrong("{ name = \"used_becomes\", block = \"gold\" }"),
                HasSubstr("behaviors.block: expected the name of a block, got \"gold\""));
    EXPECT_THAT(wrong("{ name = \"used_becomes\" }"), HasSubstr("behaviors.block: missing"));
    EXPECT_THAT(wrong("{ name = \"used_becomes\", block = \"glow\", x = 1 }"),
                HasSubstr("behaviors.x: unknown key"));
    EXPECT_THAT(wrong("{ name = \"explodes\" }"),
                HasSubstr("behaviors.name: expected one of used_becomes, touched_becomes, got \"explodes\""));
    EXPECT_THAT(wrong("\"used_becomes\""), HasSubstr("behaviors: expected { name = \"used_becomes\""));
}

}  // namespace
}  // namespace terrane::pack
