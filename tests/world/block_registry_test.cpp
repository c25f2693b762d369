#include "terrane/world/blocks/block_registry.h"

#include "terrane/world/blocks/block_description.h"
#include "terrane/world/blocks/block_model.h"

#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <algorithm>
#include <glm/vector_relational.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/world/content_blocks.h"

namespace terrane::world {
namespace {

BlockRegistry parsed(std::string_view toml) {
    auto registry = BlockRegistry::parse(toml, "blocks.toml");
    EXPECT_TRUE(registry) << (registry ? "" : registry.error().message);
    return registry ? *registry : BlockRegistry();
}

constexpr std::string_view kTwo =
    "[[block]]\nname = \"first\"\nshape = \"cube\"\ntexture = \"shared\"\n"
    "[[block]]\nname = \"second\"\nshape = \"cube\"\n"
    "textures = { top = \"shared\", bottom = \"other\", side = \"other\" }\n";

TEST(BlockRegistry, IdsFollowTheFile) {
    const BlockRegistry registry = parsed(kTwo);
    ASSERT_EQ(registry.types().size(), 4u);
    EXPECT_EQ(registry.type(0).name, "air");
    EXPECT_EQ(registry.type(1).name, "first");
    EXPECT_EQ(registry.type(2).name, "second");
    EXPECT_EQ(registry.type(3).name, "missing");
    EXPECT_EQ(registry.missing(), 3);
    for (std::size_t id = 0; id < 4; ++id) EXPECT_EQ(registry.types()[id].id, id);
}

TEST(BlockRegistry, Find) {
    const BlockRegistry registry = parsed(kTwo);
    ASSERT_NE(registry.find("second"), nullptr);
    EXPECT_EQ(registry.find("second")->id, 2);
    EXPECT_EQ(registry.find("air")->id, kAir);
    EXPECT_EQ(registry.find("missing")->id, registry.missing());
    EXPECT_EQ(registry.find("third"), nullptr);
    EXPECT_EQ(registry.find(""), nullptr);
}

TEST(BlockRegistry, UnknownIdsAreMissing) {
    const BlockRegistry registry = parsed(kTwo);
    EXPECT_EQ(registry.type(4).name, "missing");
    EXPECT_EQ(registry.type(65535).name, "missing");
}

TEST(BlockRegistry, AirAndMissing) {
    const BlockRegistry registry = parsed("");
    ASSERT_EQ(registry.types().size(), 2u);
    const BlockType& air = registry.type(kAir);
    EXPECT_EQ(air.shape, Shape::None);
    EXPECT_EQ(air.opacity, 0);
    EXPECT_TRUE(air.collision.empty());
    EXPECT_FALSE(air.selectable || air.opaqueCube);

    const BlockType& missing = registry.type(registry.missing());
    EXPECT_EQ(missing.shape, Shape::Cube);
    EXPECT_EQ(missing.opacity, 15);
    EXPECT_EQ(missing.collision.size(), 1u);
    EXPECT_TRUE(missing.opaqueCube && missing.selectable);
    EXPECT_FALSE(missing.generated);
    ASSERT_EQ(registry.textures().size(), 1u);
    EXPECT_EQ(registry.textures()[0], "missing");
}

TEST(BlockRegistry, MaterialsAreShared) {
    const BlockRegistry registry = parsed(kTwo);
    ASSERT_EQ(registry.materials().size(), 3u) << "shared, other, missing";
    EXPECT_EQ(registry.textures()[0], "shared");
    EXPECT_EQ(registry.textures()[1], "other");
    EXPECT_EQ(registry.type(1).material[kFaceNegX], registry.type(2).material[kFacePosZ]);
    EXPECT_NE(registry.type(2).material[kFaceNegX], registry.type(2).material[kFacePosZ]);
    EXPECT_EQ(registry.materials()[registry.type(2).material[kFaceNegZ]].texture, 1);
}

TEST(BlockRegistry, MaterialsDifferByEveryProperty) {
    std::string file;
    for (const char* look : {"", "alpha = \"test\"\n", "two_sided = true\n", "animation = \"top_waves\"\n",
                             "wrap = \"clamp\"\n", "sharp = true\n", "tint = true\n"})
        file += fmt::format("[[block]]\nname = \"b{}\"\nshape = \"cross\"\ntexture = \"a\"\nopacity = 0\n{}",
                            file.size(), look);
    const BlockRegistry registry = parsed(file);
    EXPECT_EQ(registry.materials().size(), 7u + 1);
    EXPECT_EQ(registry.textures().size(), 2u);
    EXPECT_EQ(registry.materials()[1].alpha, AlphaMode::Test);
    EXPECT_TRUE(registry.materials()[2].twoSided);
    EXPECT_EQ(registry.materials()[3].animation, Animation::TopWaves);
    EXPECT_EQ(registry.materials()[4].wrap, Wrap::Clamp);
    EXPECT_EQ(registry.materials()[5].filtering, Filtering::Sharp);
    EXPECT_TRUE(registry.materials()[6].tinted);
}

TEST(BlockRegistry, ErrorsArePassedOn) {
    const auto registry = BlockRegistry::parse("[[block]]\nname = \"a\"\n", "my.toml");
    ASSERT_FALSE(registry);
    EXPECT_EQ(registry.error().message, "my.toml:1: shape: missing (required)");
}

// 16 bits number materials: 21,845 blocks of three materials fill them with one left for "missing".
TEST(BlockRegistry, NumberOfMaterials) {
    std::string file;
    const auto add = [&](int i) {
        file += fmt::format(
            "[[block]]\nname=\"b{0}\"\nshape=\"cube\"\ntextures={{top=\"t{0}\",bottom=\"b{0}\",side=\"s{0}\"}"
            "}\n",
            i);
    };
    for (int i = 0; i < 21845; ++i) add(i);
    EXPECT_EQ(parsed(file).materials().size(), 65536u);
    add(21845);
    const auto registry = BlockRegistry::parse(file, "blocks.toml");
    ASSERT_FALSE(registry);
    EXPECT_EQ(registry.error().message,
              "blocks.toml:87381: texture: expected at most 65536 different faces in all blocks, got more");
}

// The tables of the file's blocks, in its order, each with the keys of the block that it is like.
std::vector<toml::table> contentFile() {
    const toml::table file = toml::parse_file(TERRANE_SOURCE_DIR "/assets/blocks.toml");
    std::vector<toml::table> blocks;
    for (const toml::node& node : *file["block"].as_array()) {
        toml::table block = *node.as_table();
        const auto like = std::ranges::find_if(blocks, [&](const toml::table& other) {
            return other["name"].value<std::string>() == block["like"].value<std::string>();
        });
        if (like != blocks.end()) {
            toml::table keys = *like;
            if (block.contains("texture") || block.contains("textures")) {
                keys.erase("texture");
                keys.erase("textures");
            }
            for (const auto& [key, value] : block) keys.insert_or_assign(key, value);
            block = std::move(keys);
        }
        blocks.push_back(std::move(block));
    }
    return blocks;
}

// The textures of a table of the file: top, bottom and four sides.
std::vector<std::string> texturesIn(const toml::table& block) {
    const auto of = [&](std::string_view faces) {
        const auto all = block["texture"].value<std::string>();
        return all ? *all : block["textures"][faces].value<std::string>().value();
    };
    std::vector<std::string> textures(kFaceCount, of("side"));
    textures[kFacePosZ] = of("top");
    textures[kFaceNegZ] = of("bottom");
    return textures;
}

TEST(Content, HasTheBlocksOfTheFileInItsOrder) {
    const std::vector<toml::table> blocks = contentFile();
    ASSERT_EQ(contentBlocks().types().size(), blocks.size() + 2) << "air first, missing last";
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const toml::table& block = blocks[k];
        const BlockType& type = contentBlocks().types()[k + 1];
        ASSERT_EQ(type.name, block["name"].value<std::string>());
        SCOPED_TRACE(type.name);
        EXPECT_EQ(type.id, k + 1);
        EXPECT_EQ(contentBlocks().find(type.name), &type);
        EXPECT_EQ(type.opacity, block["opacity"].value_or(15));
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(type.emission[c], block["emission"][c].value_or(0));
        EXPECT_EQ(!type.collision.empty(), block["collides"].value_or(true));
        EXPECT_EQ(type.selectable, block["selectable"].value_or(true));
        EXPECT_EQ(type.generated, block["generated"].value_or(true));
        EXPECT_EQ(type.innerFaces, block["inner_faces"].value_or(false));
        EXPECT_EQ(type.climbable, block["climbable"].value_or(false));
        EXPECT_EQ(type.replaceable, block["replaceable"].value_or(false));
        EXPECT_EQ(type.slots, block["slots"].value_or(0));
        EXPECT_EQ(type.growth.size(), block["growth"] ? block["growth"].as_array()->size() : 0);
        for (glm::length_t axis = 0; axis < 3 && block["selection"]; ++axis) {
            const auto corner = [&](std::size_t number) {
                return block["selection"][number][static_cast<std::size_t>(axis)];
            };
            EXPECT_EQ(type.selection.min[axis], corner(0).value<float>());
            EXPECT_EQ(type.selection.max[axis], corner(1).value<float>());
        }
        const std::vector<std::string> textures = texturesIn(block);
        for (std::size_t face = 0; face < kFaceCount; ++face)
            EXPECT_EQ(contentBlocks().textures()[contentBlocks().materials()[type.material[face]].texture],
                      textures[face]);
    }
}

bool isWithinTheCell(const Box& box) {
    return glm::all(glm::lessThanEqual(glm::vec3(0), box.min)) && glm::all(glm::lessThan(box.min, box.max)) &&
           glm::all(glm::lessThanEqual(box.max, glm::vec3(1)));
}

TEST(Content, FollowsTheRulesOfShapesAndLooks) {
    for (const BlockType& type : contentBlocks().types()) {
        SCOPED_TRACE(type.name);
        EXPECT_EQ(type.model != nullptr, type.shape == Shape::Model);
        EXPECT_TRUE(std::ranges::all_of(type.collision, isWithinTheCell));
        EXPECT_TRUE(isWithinTheCell(type.selection));
        EXPECT_TRUE(type.growth.empty() || type.shape == Shape::Cross || type.shape == Shape::Hash);
        const auto isClosed = [](std::uint16_t material) {
            const AlphaMode alpha = contentBlocks().materials()[material].alpha;
            return alpha == AlphaMode::Unused || alpha == AlphaMode::Glow || alpha == AlphaMode::Tint;
        };
        EXPECT_EQ(type.opaqueCube, type.shape == Shape::Cube && std::ranges::all_of(type.material, isClosed));
    }
}

// Torches and ladders are removed with the wall at which they lean; doors have two halves.
TEST(Content, WhatOnePlacesBehaves) {
    const auto behaviorOf = [](std::string_view name) {
        return contentBlocks().find(name)->behaviors.at(0)->name;
    };
    EXPECT_EQ(behaviorOf("torch"), "stands_or_leans");
    EXPECT_EQ(behaviorOf("ladder"), "leans");
    EXPECT_EQ(behaviorOf("lantern"), "stands");
    EXPECT_EQ(behaviorOf("oak_fence"), "connects");
    EXPECT_EQ(behaviorOf("oak_gate"), "opens");
    EXPECT_EQ(behaviorOf("oak_door"), "door");
    EXPECT_EQ(behaviorOf("oak_door_top"), "door");
    EXPECT_TRUE(contentBlocks().find("ladder")->climbable);
    EXPECT_TRUE(contentBlocks().find("tall_grass")->replaceable);
    EXPECT_FALSE(contentBlocks().find("poppy")->replaceable);
}

TEST(Content, WheatGrowsAndChestsHold) {
    const BlockType& wheat = *contentBlocks().find("wheat");
    ASSERT_EQ(wheat.growth.size(), 3u);
    const auto textureOfStage = [&](std::size_t left) {
        return contentBlocks().textures()[contentBlocks().materials()[wheat.growth[left - 1]].texture];
    };
    EXPECT_EQ(textureOfStage(1), "wheat_2");
    EXPECT_EQ(textureOfStage(3), "wheat_0");
    const Material& youngest = contentBlocks().materials()[wheat.growth[2]];
    EXPECT_EQ(youngest.alpha, AlphaMode::Test);
    EXPECT_EQ(youngest.animation, Animation::TopWaves);
    EXPECT_TRUE(youngest.twoSided);
    EXPECT_EQ(contentBlocks().find("chest")->slots, 27);
    EXPECT_EQ(contentBlocks().find("stone")->slots, 0);
}

TEST(Content, ACactusIsNarrowerThanItsCell) {
    EXPECT_EQ(contentBlocks().find("cactus")->collision[0].min, glm::vec3(0.0625f, 0.0625f, 0));
}

Material materialOf(std::string_view name, Face face) {
    return contentBlocks().materials()[contentBlocks().find(name)->material[face]];
}

std::string textureOf(std::string_view name, Face face) {
    return contentBlocks().textures()[materialOf(name, face).texture];
}

TEST(Content, Textures) {
    EXPECT_EQ(textureOf("grass", kFacePosZ), "grass_top");
    EXPECT_EQ(textureOf("grass", kFaceNegZ), "dirt");
    EXPECT_EQ(textureOf("grass", kFaceNegX), "grass_side");
    EXPECT_EQ(textureOf("snow", kFacePosZ), "snow");
    EXPECT_EQ(textureOf("snow", kFacePosY), "snow");
    EXPECT_EQ(textureOf("snow", kFaceNegZ), "snow");
    EXPECT_EQ(textureOf("oak_log", kFaceNegZ), "oak_log_top");
    EXPECT_EQ(textureOf("oak_log", kFaceNegY), "oak_log_side");
    EXPECT_EQ(textureOf("cactus", kFaceNegZ), "cactus_bottom");
    EXPECT_EQ(contentBlocks().textures().back(), "missing");
}

TEST(Content, Looks) {
    const auto expectLook = [](std::string_view name, Face face, Material look, bool tinted = false) {
        look.tinted = tinted;
        look.texture = materialOf(name, face).texture;
        EXPECT_EQ(materialOf(name, face), look) << name << ", face " << int{face};
    };
    for (const Face face : {kFaceNegX, kFacePosX, kFaceNegY, kFacePosY, kFaceNegZ, kFacePosZ}) {
        expectLook("stone", face, {});
        expectLook("oak_leaves", face, {0, AlphaMode::Test, Animation::WholeWaves, true}, true);
        expectLook("grass_tuft", face, {0, AlphaMode::Test, Animation::TopWaves, true}, true);
        expectLook("wheat", face, {0, AlphaMode::Test, Animation::TopWaves, true});
        expectLook("red_mushroom", face, {0, AlphaMode::Test, Animation::None, true});
        expectLook("glowing_mushroom", face, {0, AlphaMode::TestGlow, Animation::None, true});
        expectLook("glowing_ore", face, {0, AlphaMode::Glow, Animation::None, false});
        expectLook("lamp_blue", face, {0, AlphaMode::Glow, Animation::None, false});
        expectLook("cyan_glass", face, {0, AlphaMode::Blend, Animation::None, true});
        expectLook("water", face, {0, AlphaMode::Blend, Animation::LiquidSurface, true});
        const bool side = face != kFaceNegZ && face != kFacePosZ;
        expectLook("cactus", face, {0, side ? AlphaMode::Test : AlphaMode::Unused, Animation::None, side});
    }
}

// Cubes with holes, such as leaves, are closed and not animated; all else looks as it does nearby.
TEST(Content, SeenFromAfar) {
    const auto isHoled = [](std::uint16_t material) {
        return contentBlocks().materials()[material].alpha == AlphaMode::Test;
    };
    const BlockRegistry far = contentBlocks().forFarTiles();
    ASSERT_EQ(far.types().size(), contentBlocks().types().size());
    EXPECT_EQ(far.materials().size(), contentBlocks().materials().size()) << "those of both are in one table";
    for (const BlockType& near : contentBlocks().types()) {
        const BlockType& type = far.type(near.id);
        EXPECT_EQ(type.name, near.name);
        const bool hasHoles = near.shape == Shape::Cube && std::ranges::any_of(near.material, isHoled);
        if (hasHoles) {
            EXPECT_TRUE(type.opaqueCube) << near.name;
            continue;
        }
        if (near.model) {
            EXPECT_EQ(type.opaqueCube, near.model->isBulky) << near.name;
            continue;
        }
        EXPECT_EQ(type.material, near.material) << near.name;
        EXPECT_EQ(type.opaqueCube, near.opaqueCube) << near.name;
    }
    const BlockType& leaves = *far.find("oak_leaves");
    EXPECT_TRUE(leaves.opaqueCube);
    const Material& near = contentBlocks().materials()[contentBlocks().find("oak_leaves")->material[0]];
    const Material& material = far.materials()[leaves.material[0]];
    EXPECT_EQ(material.texture, near.texture);
    EXPECT_EQ(material.alpha, AlphaMode::Unused);
    EXPECT_EQ(material.animation, Animation::None);
    EXPECT_FALSE(material.twoSided);
}

TEST(Content, MaterialsAreUnique) {
    const auto materials = contentBlocks().materials();
    for (std::size_t a = 0; a < materials.size(); ++a)
        for (std::size_t b = a + 1; b < materials.size(); ++b) EXPECT_FALSE(materials[a] == materials[b]);
    const std::set<std::string> textures(contentBlocks().textures().begin(),
                                         contentBlocks().textures().end());
    EXPECT_EQ(textures.size(), contentBlocks().textures().size());
}

// Made by a program, without a file.
TEST(BlockRegistry, IsMadeFromDescriptions) {
    BlockDescription stone;
    stone.type.name = "mine:stone";
    stone.type.emission = {0, 7, 0};
    stone.faces.fill({.texture = "mine:stone"});
    const auto blocks = BlockRegistry::fromDescriptions({stone}, "program");
    ASSERT_TRUE(blocks) << blocks.error().message;
    ASSERT_NE(blocks->find("mine:stone"), nullptr);
    EXPECT_EQ(blocks->find("mine:stone")->emission[1], 7);
    EXPECT_TRUE(blocks->find("mine:stone")->opaqueCube);
    EXPECT_EQ(blocks->textures()[0], "mine:stone");
    stone.file = "program";
    const auto twice = BlockRegistry::fromDescriptions({stone, stone}, "program");
    ASSERT_FALSE(twice);
    EXPECT_EQ(twice.error().message, "program:0: name: expected a name not used before, got \"mine:stone\"");
}

}  // namespace
}  // namespace terrane::world
