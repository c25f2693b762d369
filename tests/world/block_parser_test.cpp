#include "terrane/world/blocks/block_parser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace terrane::world {
namespace {

using testing::StartsWith;

// A block that lacks nothing, to which a case adds one line: the fifth of the file.
std::string cubeWith(std::string_view line) {
    return fmt::format("[[block]]\nname = \"rock\"\nshape = \"cube\"\ntexture = \"rock\"\n{}\n", line);
}

std::string errorOf(std::string_view toml) {
    const auto blocks = parseBlocks(toml, "blocks.toml");
    return blocks ? "no error" : blocks.error().message;
}

BlockDescription only(std::string_view toml) {
    const auto file = parseBlocks(toml, "blocks.toml");
    EXPECT_TRUE(file) << (file ? "" : file.error().message);
    if (!file || file->blocks.size() != 1) return {};
    return file->blocks.front();
}

struct BadLine {
    std::string_view line, error;
};

constexpr std::string_view kAllKeys =
    "name, like, shape, texture, textures, alpha, animation, two_sided, wrap, sharp, inner_faces, opacity, "
    "emission, "
    "collides, selection, selectable, needs_ground, generated, growth, slots, surface_height, wave_height, "
    "behaviors, tint, climbable, replaceable, group, sound, hardness, tool, tool_level, drops";

// What the second of two blocks does not set is as in the first.
constexpr std::string_view kLamp =
    "[[block]]\nname = \"lamp\"\nshape = \"cube\"\ntextures = { top = \"a\", bottom = \"b\", side = \"c\" }\n"
    "alpha = \"glow\"\nemission = [15, 0, 0]\nsound = \"glass\"\n";

TEST(BlockParser, ABlockIsLikeAnother) {
    const auto file =
        parseBlocks(fmt::format("{}[[block]]\nname = \"dim\"\nlike = \"lamp\"\nemission = [3, 0, 0]\n"
                                "[[block]]\nname = \"dark\"\nlike = \"dim\"\ntexture = \"d\"\n",
                                kLamp),
                    "blocks.toml");
    ASSERT_TRUE(file) << file.error().message;
    const BlockDescription &lamp = file->blocks[0], &dim = file->blocks[1], &dark = file->blocks[2];
    EXPECT_EQ(dim.type.name, "dim");
    EXPECT_EQ(dim.type.sound, SoundMaterial::Glass);
    EXPECT_EQ(dim.type.opacity, lamp.type.opacity);
    EXPECT_EQ(dim.type.emission[0], 3);
    EXPECT_EQ(dim.faces[kFacePosZ].texture, "a");
    EXPECT_EQ(dim.faces[kFaceNegX].alpha, AlphaMode::Glow);
    EXPECT_EQ(dark.type.emission[0], 3) << "like a block that is like another";
    for (const FaceDescription& face : dark.faces)
        EXPECT_EQ(face.texture, "d") << "texture replaces textures";
}

TEST(BlockParser, ABlockIsLikeNoneButThoseAbove) {
    const auto withLike = [](std::string_view name) {
        return errorOf(fmt::format("{}[[block]]\nname = \"other\"\nlike = {}\n[[block]]\nname = \"below\"\n",
                                   kLamp, name));
    };
    for (const std::string_view name : {"\"other\"", "\"below\"", "\"air\"", "\"missing\"", "3"})
        EXPECT_EQ(
            withLike(name),
            fmt::format("blocks.toml:10: like: expected the name of a block above, in the same file, got {}",
                        name));
    EXPECT_EQ(errorOf(fmt::format("{}[[block]]\nlike = \"lamp\"\n", kLamp)),
              "blocks.toml:8: name: missing (required)");
}

TEST(BlockParser, ABlockThatIsLikeAnotherMayLackAKey) {
    EXPECT_EQ(
        errorOf(fmt::format("{}[[block]]\nname = \"plant\"\nlike = \"lamp\"\nshape = \"liquid\"\n", kLamp)),
        "blocks.toml:8: opacity: missing (only opaque cubes have a default)");
}

TEST(BlockParser, Sounds) {
    EXPECT_EQ(only(cubeWith("sound = \"wool\"")).type.sound, SoundMaterial::Wool);
    EXPECT_EQ(only(cubeWith("sound = \"none\"")).type.sound, SoundMaterial::None);
    EXPECT_EQ(only(cubeWith("")).type.sound, SoundMaterial::Stone);
    const std::string head = "[[block]]\nname = \"thing\"\ntexture = \"thing\"\nopacity = 0\nshape = ";
    EXPECT_EQ(only(head + "\"liquid\"").type.sound, SoundMaterial::Water);
    EXPECT_EQ(only(head + "\"cross\"").type.sound, SoundMaterial::Grass);
}

TEST(BlockParser, BadLines) {
    constexpr BadLine kCases[] = {
        {"opacity = 40", "blocks.toml:5: opacity: expected 0 to 15, got 40"},
        {"opacity = -1", "blocks.toml:5: opacity: expected 0 to 15, got -1"},
        {"opacity = 3.0", "blocks.toml:5: opacity: expected 0 to 15, got 3.0"},
        {"opacity = true", "blocks.toml:5: opacity: expected 0 to 15, got true"},
        {"emission = 15", "blocks.toml:5: emission: expected [red, green, blue], got 15"},
        {"emission = [1, 2]", "blocks.toml:5: emission: expected [red, green, blue], got an array of 2"},
        {"emission = [1, 2, 16]", "blocks.toml:5: emission: expected 0 to 15, got 16"},
        {"emission = [1,\n 2,\n \"3\"]", "blocks.toml:7: emission: expected 0 to 15, got \"3\""},
        {"sound = \"mud\"",
         "blocks.toml:5: sound: expected one of none, stone, wood, earth, sand, grass, glass, wool, metal, "
         "snow, "
         "water, got \"mud\""},
        {"collides = 1", "blocks.toml:5: collides: expected true or false, got 1"},
        {"generated = \"no\"", "blocks.toml:5: generated: expected true or false, got \"no\""},
        {"selectable = []", "blocks.toml:5: selectable: expected true or false, got an array of 0"},
        {"inner_faces = {}", "blocks.toml:5: inner_faces: expected true or false, got a table"},
        {"two_sided = \"yes\"", "blocks.toml:5: two_sided: expected true or false, got \"yes\""},
        {"two_sided = { top = 1 }", "blocks.toml:5: two_sided.top: expected true or false, got 1"},
        {"alpha = \"holes\"",
         "blocks.toml:5: alpha: expected one of unused, test, blend, glow, test_glow, tint, got \"holes\""},
        {"alpha = { side = 3 }",
         "blocks.toml:5: alpha.side: expected one of unused, test, blend, glow, test_glow, tint, got 3"},
        {"alpha = { north = \"test\" }",
         "blocks.toml:5: alpha.north: unknown key, expected one of top, bottom, side"},
        {"animation = \"spins\"",
         "blocks.toml:5: animation: expected one of none, top_waves, whole_waves, liquid_surface, got "
         "\"spins\""},
        {"textures = { top = \"a\", bottom = \"a\", side = \"a\" }",
         "blocks.toml:5: textures: expected only one of texture and textures, got a table"},
        {"wrap = \"mirror\"", "blocks.toml:5: wrap: expected one of quad, repeat, clamp, got \"mirror\""},
        {"sharp = \"off\"", "blocks.toml:5: sharp: expected true or false, got \"off\""},
        {"sharp = { top = 1 }", "blocks.toml:5: sharp.top: expected true or false, got 1"},
        {"tint = \"green\"", "blocks.toml:5: tint: expected true or false, got \"green\""},
        {"tint = { side = 2 }", "blocks.toml:5: tint.side: expected true or false, got 2"},
        {"alpha = { side = \"tint\" }\ntint = { top = true }",
         "blocks.toml:5: alpha: expected tint = true for faces with alpha = \"tint\", got a table"},
        {"surface_height = 0.5",
         "blocks.toml:5: surface_height: expected surface_height only for the shape liquid, got 0.5"},
        {"wave_height = 0.1",
         "blocks.toml:5: wave_height: expected wave_height only with the shape liquid and animation = "
         "\"liquid_surface\", got 0.1"},
        {"behaviors = \"falling\"",
         "blocks.toml:5: behaviors: expected an array of names and tables, got \"falling\""},
        {"behaviors = [\"plant\",\n \"flies\"]",
         "blocks.toml:6: behaviors: expected one of plant, crop, falling, container, workbench, flows, "
         "stands, leans, "
         "stands_or_leans, connects, opens, door, sign, used_becomes, touched_becomes, got \"flies\""},
        {"alpha = \"test\"", "blocks.toml:1: opacity: missing (only opaque cubes have a default)"},
        {"alpha = { top = \"blend\" }", "blocks.toml:1: opacity: missing (only opaque cubes have a default)"},
        {"[[block]]\nname = \"rock\"\nshape = \"cube\"\ntexture = \"rock\"",
         "blocks.toml:6: name: expected a name not used before, got \"rock\""},
        {"[[block]]\nname = \"air\"\nshape = \"cube\"\ntexture = \"rock\"",
         "blocks.toml:6: name: expected a name not used before, got \"air\""},
        {"[[block]]\nname = \"missing\"\nshape = \"cube\"\ntexture = \"rock\"",
         "blocks.toml:6: name: expected a name not used before, got \"missing\""},
    };
    for (const BadLine& c : kCases) EXPECT_EQ(errorOf(cubeWith(c.line)), c.error) << c.line;
}

// A liquid that lacks nothing, to which a case adds lines from the eighth on.
std::string liquidWith(std::string_view lines) {
    return fmt::format(
        "[[block]]\nname = \"oil\"\nshape = \"liquid\"\ntexture = \"oil\"\nalpha = \"blend\"\nopacity = 1\n"
        "animation = \"liquid_surface\"\n{}\n",
        lines);
}

TEST(BlockParser, BadSurfaces) {
    constexpr BadLine kCases[] = {
        {"surface_height = 1.5", "blocks.toml:8: surface_height: expected 0.125 to 1, got 1.5"},
        {"surface_height = nan", "blocks.toml:8: surface_height: expected 0.125 to 1, got nan"},
        {"surface_height = true", "blocks.toml:8: surface_height: expected 0.125 to 1, got true"},
        {"wave_height = -0.1", "blocks.toml:8: wave_height: expected 0 to 0.25, got -0.1"},
        {"surface_height = 0.25\nwave_height = 0.2",
         "blocks.toml:9: wave_height: expected 0 to 0.1875, got 0.2"},
    };
    for (const BadLine& c : kCases) EXPECT_EQ(errorOf(liquidWith(c.line)), c.error) << c.line;
}

TEST(BlockParser, Surfaces) {
    const auto surfaceOf = [](std::string_view lines) { return only(liquidWith(lines)).type.surface; };
    EXPECT_EQ(surfaceOf(""), (LiquidSurface{896, 60}));
    EXPECT_EQ(surfaceOf("surface_height = 1"), (LiquidSurface{1024, 60}));
    EXPECT_EQ(surfaceOf("surface_height = 0.5\nwave_height = 0"), (LiquidSurface{512, 0}));
    EXPECT_EQ(surfaceOf("wave_height = 0.25"), (LiquidSurface{896, 250}));
}

TEST(BlockParser, SamplingOfFaces) {
    const BlockDescription block =
        only(cubeWith("wrap = { top = \"repeat\", side = \"clamp\" }\nsharp = false"));
    EXPECT_EQ(block.faces[kFacePosZ].wrap, Wrap::Repeat);
    EXPECT_EQ(block.faces[kFaceNegZ].wrap, Wrap::Quad);
    EXPECT_EQ(block.faces[kFacePosX].wrap, Wrap::Clamp);
    for (const FaceDescription& face : block.faces) EXPECT_EQ(face.filtering, Filtering::Nearest);
    const BlockDescription some = only(cubeWith("sharp = { bottom = true }"));
    EXPECT_EQ(some.faces[kFaceNegZ].filtering, Filtering::Sharp);
    EXPECT_EQ(some.faces[kFacePosZ].filtering, Filtering::Option);
}

TEST(BlockParser, BadSelection) {
    constexpr std::string_view kExpected =
        "blocks.toml:5: selection: expected [[x, y, z], [x, y, z]] from 0 to 1, the lower corner first, got ";
    constexpr BadLine kCases[] = {
        {"selection = 1", "1"},
        {"selection = [0, 1]", "an array of 2"},
        {"selection = [[0, 0, 0]]", "an array of 1"},
        {"selection = [[0, 0], [1, 1]]", "an array of 2"},
        {"selection = [[0, 0, 0], [1, 1, 1.5]]", "an array of 2"},
        {"selection = [[0, 0, -0.5], [1, 1, 1]]", "an array of 2"},
        {"selection = [[0, 0, 0], [1, 1, nan]]", "an array of 2"},
        {"selection = [[0, 0, 0], [1, 1, \"1\"]]", "an array of 2"},
        {"selection = [[0, 0, 1], [1, 1, 0]]", "an array of 2"},
        {"selection = [[0, 0, 0], [1, 0, 1]]", "an array of 2"},
    };
    for (const BadLine& c : kCases)
        EXPECT_EQ(errorOf(cubeWith(c.line)), fmt::format("{}{}", kExpected, c.error)) << c.line;
}

TEST(BlockParser, UnknownKeys) {
    EXPECT_EQ(errorOf(cubeWith("color = 1")),
              fmt::format("blocks.toml:5: color: unknown key, expected one of {}", kAllKeys));
    EXPECT_EQ(errorOf(cubeWith("zeta = 1\nalfa = 2")),
              fmt::format("blocks.toml:5: zeta: unknown key, expected one of {}", kAllKeys))
        << "the first of the file, not of the alphabet";
    EXPECT_EQ(errorOf(cubeWith("\"a\\nb\" = 1")),
              fmt::format("blocks.toml:5: a b: unknown key, expected one of {}", kAllKeys))
        << "one line";
    EXPECT_EQ(errorOf("title = \"x\"\n"), "blocks.toml:1: title: unknown key, expected one of block, shape");
}

TEST(BlockParser, MissingKeys) {
    constexpr BadLine kCases[] = {
        {"\n[[block]]\nshape = \"cube\"\ntexture = \"a\"", "blocks.toml:2: name: missing (required)"},
        {"[[block]]\nname = \"a\"\ntexture = \"a\"", "blocks.toml:1: shape: missing (required)"},
        {"[[block]]\nname = \"a\"\nshape = \"cube\"", "blocks.toml:1: texture: missing (or textures)"},
        {"[[block]]\nname = \"a\"\nshape = \"cube\"\ntextures = { top = \"a\", side = \"a\" }",
         "blocks.toml:1: textures.bottom: missing (required)"},
        {"[[block]]\nname = \"a\"\nshape = \"liquid\"\ntexture = \"a\"",
         "blocks.toml:1: opacity: missing (only opaque cubes have a default)"},
        {"[[block]]", "blocks.toml:1: name: missing (required)"},
    };
    for (const BadLine& c : kCases) EXPECT_EQ(errorOf(c.line), c.error) << c.line;
}

TEST(BlockParser, BadNamesAndShapes) {
    constexpr BadLine kCases[] = {
        {"name = \"Rock\"", "blocks.toml:2: name: expected a name of a-z, 0-9 and _, got \"Rock\""},
        {"name = \"\"", "blocks.toml:2: name: expected a name of a-z, 0-9 and _, got \"\""},
        {"name = 7", "blocks.toml:2: name: expected a name of a-z, 0-9 and _, got 7"},
        {"name = \"a/../b\"", "blocks.toml:2: name: expected a name of a-z, 0-9 and _, got \"a/../b\""},
        {"name = \"a\"\nshape = \"ball\"",
         "blocks.toml:3: shape: expected one of cube, liquid, cross, hash, inset, got \"ball\""},
        {"name = \"a\"\nshape = 1",
         "blocks.toml:3: shape: expected one of cube, liquid, cross, hash, inset, got 1"},
        {"name = \"a\"\nshape = \"cube\"\ntexture = \"../x\"",
         "blocks.toml:4: texture: expected a name of a-z, 0-9 and _, got \"../x\""},
        {"name = \"a\"\nshape = \"cube\"\ntexture = { top = \"x\" }",
         "blocks.toml:4: texture: expected a name of a-z, 0-9 and _, got a table"},
        {"name = \"a\"\nshape = \"cube\"\ntextures = \"x\"",
         "blocks.toml:4: textures: expected a table of top, bottom and side, got \"x\""},
        {"name = \"a\"\nshape = \"cube\"\ntextures = { top = 1, bottom = \"x\", side = \"x\" }",
         "blocks.toml:4: textures.top: expected a name of a-z, 0-9 and _, got 1"},
        {"name = \"a\"\nshape = \"cube\"\ntextures = { up = \"x\" }",
         "blocks.toml:4: textures.up: unknown key, expected one of top, bottom, side"},
    };
    for (const BadLine& c : kCases)
        EXPECT_EQ(errorOf(fmt::format("[[block]]\n{}\n", c.line)), c.error) << c.line;
}

TEST(BlockParser, BlocksMustBeTables) {
    constexpr std::string_view kExpected =
        "blocks.toml:1: block: expected tables that begin with [[block]], got ";
    EXPECT_EQ(errorOf("block = 3"), fmt::format("{}3", kExpected));
    EXPECT_EQ(errorOf("[block]\nname = \"a\""), fmt::format("{}a table", kExpected));
    EXPECT_EQ(errorOf("block = [1, {}]"), fmt::format("{}an array of 2", kExpected));
}

// The text after the line number is the TOML library's.
TEST(BlockParser, SyntaxErrors) {
    EXPECT_THAT(errorOf("[[block]]\nname = \"a\"\nshape = \n"), StartsWith("blocks.toml:3: syntax: "));
    EXPECT_THAT(errorOf("[[block]\n"), StartsWith("blocks.toml:1: syntax: "));
    EXPECT_THAT(errorOf("[[block]]\nname = \"a\"\nname = \"b\"\n"), StartsWith("blocks.toml:3: syntax: "));
    EXPECT_THAT(errorOf("a = \"\xff\""), StartsWith("blocks.toml:1: syntax: "));
    EXPECT_EQ(errorOf("a = \"\n\"").find('\n'), std::string::npos);
}

// Every beginning of a valid file is read or refused, never worse.
TEST(BlockParser, EveryTruncation) {
    const std::string whole = cubeWith(
        "alpha = { side = \"test\", top = \"unused\" }\nopacity = 3\nemission = [1, 2, 3]\n"
        "selection = [[0, 0, 0], [1, 1, 0.5]]");
    EXPECT_EQ(errorOf(whole), "no error");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string error = errorOf(std::string_view(whole).substr(0, size));
        EXPECT_TRUE(error == "no error" || error.starts_with("blocks.toml:")) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST(BlockParser, NumberOfBlocks) {
    std::string file;
    for (std::size_t i = 0; i < kMaxDescribedBlocks; ++i)
        file += fmt::format("[[block]]\nname=\"b{}\"\nshape=\"cube\"\ntexture=\"a\"\n", i);
    EXPECT_EQ(errorOf(file), "no error");
    file += "[[block]]\nname=\"last\"\nshape=\"cube\"\ntexture=\"a\"\n";
    EXPECT_EQ(errorOf(file), "blocks.toml:262137: block: expected at most 65534, got more");
}

TEST(BlockParser, Defaults) {
    const BlockDescription block = only(cubeWith(""));
    EXPECT_EQ(block.type.name, "rock");
    EXPECT_EQ(block.type.shape, Shape::Cube);
    EXPECT_EQ(block.type.opacity, 15);
    EXPECT_EQ(block.type.emission, (std::array<std::uint8_t, 3>{0, 0, 0}));
    EXPECT_EQ(block.type.collision.size(), 1u);
    EXPECT_TRUE(block.type.selectable && block.type.generated);
    EXPECT_FALSE(block.type.innerFaces);
    EXPECT_EQ(block.animation, Animation::None);
    EXPECT_TRUE(isOpaqueCube(block));
    EXPECT_EQ(block.line, 1);
    for (const FaceDescription& face : block.faces) {
        EXPECT_EQ(face.texture, "rock");
        EXPECT_EQ(face.alpha, AlphaMode::Unused);
        EXPECT_FALSE(face.twoSided);
        EXPECT_EQ(face.wrap, Wrap::Quad);
        EXPECT_EQ(face.filtering, Filtering::Option);
        EXPECT_FALSE(face.tinted);
    }
}

TEST(BlockParser, Tint) {
    const BlockDescription grass =
        only(cubeWith("tint = { top = true, side = true }\nalpha = { side = \"tint\" }"));
    EXPECT_TRUE(grass.faces[kFacePosZ].tinted && grass.faces[kFaceNegY].tinted);
    EXPECT_FALSE(grass.faces[kFaceNegZ].tinted);
    EXPECT_EQ(grass.faces[kFaceNegY].alpha, AlphaMode::Tint);
    EXPECT_TRUE(isOpaqueCube(grass));
}

TEST(BlockParser, FaceGroups) {
    const BlockDescription block = only(
        "[[block]]\nname = \"a\"\nshape = \"inset\"\ntextures = { top = \"t\", bottom = \"b\", side = \"s\" "
        "}\n"
        "alpha = { side = \"test\" }\ntwo_sided = { top = true }\nopacity = 0\n");
    for (const Face face : {kFaceNegX, kFacePosX, kFaceNegY, kFacePosY}) {
        EXPECT_EQ(block.faces[face].texture, "s");
        EXPECT_EQ(block.faces[face].alpha, AlphaMode::Test);
        EXPECT_FALSE(block.faces[face].twoSided);
    }
    EXPECT_EQ(block.faces[kFacePosZ].texture, "t");
    EXPECT_EQ(block.faces[kFacePosZ].alpha, AlphaMode::Unused);
    EXPECT_TRUE(block.faces[kFacePosZ].twoSided);
    EXPECT_EQ(block.faces[kFaceNegZ].texture, "b");
    EXPECT_FALSE(isOpaqueCube(block));
}

TEST(BlockParser, BoxesOfShapes) {
    const BlockDescription inset =
        only("[[block]]\nname = \"a\"\nshape = \"inset\"\ntexture = \"t\"\nopacity = 0\n");
    ASSERT_EQ(inset.type.collision.size(), 1u);
    for (const Box& box : {inset.type.collision[0], inset.type.selection}) {
        EXPECT_EQ(box.min, glm::vec3(0.0625f, 0.0625f, 0));
        EXPECT_EQ(box.max, glm::vec3(0.9375f, 0.9375f, 1));
    }
    const BlockDescription low = only(cubeWith("collides = false\nselection = [[0, 0.25, 0], [1, 1, 0.5]]"));
    EXPECT_TRUE(low.type.collision.empty());
    EXPECT_EQ(low.type.selection.min, glm::vec3(0, 0.25f, 0));
    EXPECT_EQ(low.type.selection.max, glm::vec3(1, 1, 0.5f));
}

TEST(BlockParser, EmptyFileHasNoBlocks) {
    const auto file = parseBlocks("# nothing\n", "blocks.toml");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->blocks.empty());
}

}  // namespace
}  // namespace terrane::world
