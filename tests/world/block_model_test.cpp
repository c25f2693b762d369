#include "terrane/world/blocks/block_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/character.h"
#include "terrane/world/ray_cast.h"
#include "tests/world/test_shapes.h"

namespace terrane::world {
namespace {

using Part = std::tuple<int, int, int, int>;  // side, then where its sixteenth lies

bool isIn(std::span<const ShapeBox> boxes, glm::ivec3 at) {
    return std::ranges::any_of(boxes, [&](const ShapeBox& box) {
        return at.x >= box.min.x && at.y >= box.min.y && at.z >= box.min.z && at.x < box.max.x &&
               at.y < box.max.y && at.z < box.max.z;
    });
}

// Sixteenths of the surface, one at a time.
std::map<Part, int> partsOf(std::span<const ShapeBox> boxes) {
    std::map<Part, int> parts;
    for (int z = 0; z < 16; ++z)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                for (int side = 0; side < 6; ++side) {
                    glm::ivec3 next(x, y, z);
                    next[side / 2] += side % 2 == 1 ? 1 : -1;
                    if (isIn(boxes, {x, y, z}) && !isIn(boxes, next)) parts[{side, x, y, z}] = 1;
                }
    return parts;
}

std::map<Part, int> partsOf(const std::vector<ShapeRectangle>& rectangles) {
    std::map<Part, int> parts;
    for (const ShapeRectangle& r : rectangles) {
        glm::ivec3 min = r.min, max = r.max;
        const int axis = r.side / 2;
        (r.side % 2 == 1 ? min : max)[axis] += r.side % 2 == 1 ? -1 : 1;
        for (int z = min.z; z < max.z; ++z)
            for (int y = min.y; y < max.y; ++y)
                for (int x = min.x; x < max.x; ++x) ++parts[{r.side, x, y, z}];
    }
    return parts;
}

TEST(ShapeSurface, CoversEachPartOfRandomBoxesOnce) {
    std::mt19937 random(7);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int round = 0; round < 200; ++round) {
        std::vector<ShapeBox> boxes(1 + random() % 4);
        for (ShapeBox& box : boxes)
            for (int axis = 0; axis < 3; ++axis) {
                box.min[axis] = below(16);
                box.max[axis] = box.min[axis] + 1 + below(16 - box.min[axis]);
            }
        ASSERT_EQ(partsOf(surfaceOf(boxes)), partsOf(boxes));
    }
}

const std::string kShapes = kTestShapes + R"(
[[block]]
name = "oak_stairs"
shape = "stairs"
texture = "oak"
opacity = 15
[[block]]
name = "fence"
shape = "post"
texture = "oak"
opacity = 0
[[block]]
name = "oak_door"
shape = "door"
texture = "oak"
opacity = 0
)";

const BlockRegistry& blocks() {
    static const BlockRegistry registry = *BlockRegistry::parse(kShapes, "shapes");
    return registry;
}

const ModelForm& formOf(std::string_view name, std::uint16_t state) {
    return blocks().find(name)->model->form(state);
}

bool hasBox(const ModelForm& form, glm::vec3 min, glm::vec3 max) {
    return std::ranges::any_of(form.boxes, [&](const Box& box) { return box.min == min && box.max == max; });
}

TEST(BlockModel, StairsTurnAgainstTheClockAndStandOnTheirHead) {
    EXPECT_TRUE(hasBox(formOf("oak_stairs", 0), {0, 0.5, 0.5}, {1, 1, 1})) << "they rise toward +y";
    EXPECT_TRUE(hasBox(formOf("oak_stairs", 1), {0, 0, 0.5}, {0.5, 1, 1})) << "toward -x";
    EXPECT_TRUE(hasBox(formOf("oak_stairs", 2), {0, 0, 0.5}, {1, 0.5, 1})) << "toward -y";
    EXPECT_TRUE(hasBox(formOf("oak_stairs", 3), {0.5, 0, 0.5}, {1, 1, 1})) << "toward +x";
    EXPECT_TRUE(hasBox(formOf("oak_stairs", kStateUpsideDown), {0, 0, 0.5}, {1, 1, 1}));
    EXPECT_TRUE(hasBox(formOf("oak_stairs", kStateUpsideDown), {0, 0.5, 0}, {1, 1, 0.5}));
}

TEST(BlockModel, ArmsAndOtherForms) {
    EXPECT_EQ(formOf("fence", 0).boxes.size(), 1u);
    EXPECT_EQ(formOf("fence", kStateArms).boxes.size(), 5u);
    EXPECT_TRUE(
        hasBox(formOf("fence", 1u << 4), {0, 7 / 16.0f, 6 / 16.0f}, {6 / 16.0f, 9 / 16.0f, 9 / 16.0f}));
    EXPECT_TRUE(
        hasBox(formOf("fence", 2u << 4), {10 / 16.0f, 7 / 16.0f, 6 / 16.0f}, {1, 9 / 16.0f, 9 / 16.0f}));
    EXPECT_TRUE(hasBox(formOf("oak_door", 0), {0, 0, 0}, {1, 3 / 16.0f, 1}));
    EXPECT_TRUE(hasBox(formOf("oak_door", kStateOther), {0, 0, 0}, {3 / 16.0f, 1, 1}));
    EXPECT_EQ(formOf("oak_door", kStateUpsideDown).boxes.size(), 1u) << "a bit that doors do not have";
}

TEST(BlockModel, FacesInTheCellsSidesMayBeHidden) {
    int onBorder = 0, inside = 0;
    for (const ModelFace& face : formOf("oak_stairs", 0).faces)
        (face.hiddenBy != kFaceCount ? onBorder : inside)++;
    EXPECT_EQ(inside, 2) << "tread and riser";
    EXPECT_EQ(onBorder, 8) << "bottom, back, front, top, two rectangles on each side";
}

class ModelWorld : public testing::Test {
  protected:
    ModelWorld() {
        auto chunk = std::make_shared<Chunk>();
        chunk->setBlock(blockIndex(8, 8, 10), blocks().find("oak_stairs")->id);
        world_.insert({0, 0}, std::move(chunk));
    }
    World world_;
};

TEST_F(ModelWorld, ABodyStandsOnTheLowerHalf) {
    const Aabb body{{8.2, 8.1, 12}, {8.8, 8.4, 13}};
    EXPECT_NEAR(sweep(world_, blocks(), body, {0, 0, -5}).moved.z, -1.5, 0.001);
    const Aabb behind{{8.2, 8.6, 12}, {8.8, 8.9, 13}};
    EXPECT_NEAR(sweep(world_, blocks(), behind, {0, 0, -5}).moved.z, -1, 0.001);
}

TEST_F(ModelWorld, ARayHitsTheNearestBox) {
    const auto tread = castRay(world_, blocks(), {{8.5, 8.25, 12}, {0, 0, -1}}, 8);
    ASSERT_TRUE(tread);
    EXPECT_DOUBLE_EQ(tread->distance, 1.5);
    const auto riser = castRay(world_, blocks(), {{8.5, 7, 10.75}, {0, 1, 0}}, 8);
    ASSERT_TRUE(riser);
    EXPECT_DOUBLE_EQ(riser->distance, 1.5);
    EXPECT_EQ(riser->face, kFaceNegY);
}

TEST(BlockModel, FromAfarItIsACubeOrNotThere) {
    const BlockRegistry far = blocks().forFarTiles();
    EXPECT_EQ(far.find("oak_stairs")->shape, Shape::Cube);
    EXPECT_TRUE(far.find("oak_stairs")->opaqueCube);
    EXPECT_EQ(far.find("fence")->shape, Shape::None);
}

// Boxes of a sixteenth that touch each other nowhere: 16 of the block, and 16 of each of its four arms.
TEST(BlockModel, AFormHasAtMost255Faces) {
    const auto boxesAt = [](int y) {
        std::string boxes;
        for (int k = 0; k < 16; ++k) {
            const int x = 2 + 2 * (k % 4), z = k / 4 * 4;
            boxes +=
                fmt::format("{}[{}, {}, {}, {}, {}, {}]", k > 0 ? ", " : "", x, y, z, x + 1, y + 1, z + 1);
        }
        return boxes;
    };
    const auto errorOf = [&](bool hasArms) {
        const auto registry = BlockRegistry::parse(
            fmt::format("[[shape]]\nname = \"cloud\"\nboxes = [{}]\n{}[[block]]\nname = \"cloud\"\n"
                        "shape = \"cloud\"\ntexture = \"a\"\nopacity = 0\n",
                        boxesAt(7), hasArms ? fmt::format("arms = [{}]\n", boxesAt(0)) : ""),
            "f");
        return registry ? std::string() : registry.error().message;
    };
    EXPECT_EQ(errorOf(false), "");
    EXPECT_THAT(errorOf(true), testing::HasSubstr("255 faces in each form"));
}

// The shape of a file with one shape and a block of it.
std::string fileOf(std::string_view shape) {
    return fmt::format(
        "[[shape]]\nname = \"a\"\n{}\n[[block]]\nname = \"b\"\nshape = \"a\"\n"
        "textures = {{ top = \"t\", bottom = \"u\", side = \"s\" }}\nopacity = 0\n",
        shape);
}

struct ParsedShape {
    BlockRegistry blocks;

    const ModelForm& form(std::uint16_t state = 0) const { return blocks.find("b")->model->form(state); }
    const shared::ShapeFace& face(std::size_t number, std::uint16_t state = 0) const {
        return blocks.modelFaces()[form(state).faces[number].shapeFace - shared::kShapeFaceCount];
    }
};

ParsedShape parsedShape(std::string_view shape) {
    auto parsed = BlockRegistry::parse(fileOf(shape), "f");
    EXPECT_TRUE(parsed) << parsed.error().message;
    return {std::move(*parsed)};
}

constexpr std::array<shared::vec2, 4> kAround{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};  // as in the file

// Position, then texture coordinates of each corner, in sixteenths.
using Corners = std::vector<std::array<float, 5>>;
Corners cornersOf(const shared::ShapeFace& face) {
    Corners corners;
    for (const shared::vec2 at : kAround) {
        const shared::vec4 place = 16.0f * shapeFaceCorner(face, shared::vec4(0), at, shared::vec2(1));
        const shared::vec2 texel = 16.0f * shapeFaceTexel(face, at);
        corners.push_back({place.x, place.y, place.z, texel.x, texel.y});
    }
    return corners;
}

TEST(ShapeQuads, CornersAndTextureCoordinatesAreThoseOfTheFile) {
    const ParsedShape shape = parsedShape(
        "quads = [{ corners = [[1, 2, 3], [9.5, 4, 3], [9, 4, 12], [1, 2.0625, 8]], "
        "uv = [[0, 16], [8, 15], [8.25, 0.5], [16, 0]], texture = \"bottom\" }]");
    EXPECT_EQ(cornersOf(shape.face(0)),
              (Corners{{1, 2, 3, 0, 16}, {9.5, 4, 3, 8, 15}, {9, 4, 12, 8.25, 0.5}, {1, 2.0625, 8, 16, 0}}));
    const ModelFace& face = shape.form().faces.at(0);
    EXPECT_EQ(face.look, kFaceNegZ);
    EXPECT_EQ(face.direction, kFaceCount) << "oblique";
    EXPECT_EQ(face.hiddenBy, kFaceCount);
    EXPECT_FALSE(face.isTwoSided);
}

TEST(ShapeQuads, WithoutTextureCoordinatesTheyShowTheirPlace) {
    const ParsedShape shape =
        parsedShape("quads = [{ corners = [[2, 0, 1], [7, 0, 1], [7, 3, 9], [2, 3, 9]] }]");
    EXPECT_EQ(cornersOf(shape.face(0)),
              (Corners{{2, 0, 1, 2, 15}, {7, 0, 1, 7, 15}, {7, 3, 9, 7, 7}, {2, 3, 9, 2, 7}}));
    EXPECT_EQ(shape.form().faces[0].look, kFaceNegY) << "the side that it faces most";
}

TEST(ShapeQuads, TurnWithTheShapeAndStandOnTheirHead) {
    const ParsedShape shape = parsedShape(
        "facing = true\nhalf = true\nquads = [{ corners = [[1, 12, 2], [5, 12, 2], [5, 12, 9], "
        "[1, 12, 9]], uv = [[0, 16], [4, 16], [4, 9], [0, 9]], hidden_by = \"+y\" }, "
        "{ corners = [[0, 0, 0], [0, 16, 0], [16, 16, 0], [16, 0, 0]] }]");
    EXPECT_EQ(cornersOf(shape.face(0, 1)),
              (Corners{{4, 1, 2, 0, 16}, {4, 5, 2, 4, 16}, {4, 5, 9, 4, 9}, {4, 1, 9, 0, 9}}));
    EXPECT_EQ(shape.form(0).faces[0].hiddenBy, kFacePosY);
    EXPECT_EQ(shape.form(1).faces[0].hiddenBy, kFaceNegX);
    EXPECT_EQ(shape.form(2).faces[0].hiddenBy, kFaceNegY);
    EXPECT_EQ(shape.form(3).faces[0].hiddenBy, kFacePosX);
    EXPECT_EQ(shape.form(0).faces[0].direction, kFaceNegY);
    EXPECT_EQ(shape.form(1).faces[0].direction, kFacePosX);
    EXPECT_EQ(cornersOf(shape.face(0, kStateUpsideDown)),
              (Corners{{1, 12, 7, 0, 9}, {5, 12, 7, 4, 9}, {5, 12, 14, 4, 16}, {1, 12, 14, 0, 16}}));
    EXPECT_EQ(shape.form(0).faces[1].direction, kFaceNegZ);
    EXPECT_EQ(shape.form(0).faces[1].hiddenBy, kFaceNegZ);
    EXPECT_EQ(shape.form(kStateUpsideDown).faces[1].direction, kFacePosZ);
    EXPECT_EQ(shape.form(kStateUpsideDown).faces[1].hiddenBy, kFacePosZ);
    EXPECT_EQ(shape.form(kStateUpsideDown).faces[1].look, kFacePosZ);
}

// By default a neighbor hides a quad that lies in the cell's side and faces it, unless it is two-sided.
TEST(ShapeQuads, ANeighborHidesQuadsInItsSide) {
    const auto hiddenBy = [](std::string_view corners, std::string_view keys) {
        return parsedShape(fmt::format("quads = [{{ corners = {}{} }}]", corners, keys))
            .form()
            .faces[0]
            .hiddenBy;
    };
    constexpr std::string_view kOutward = "[[16, 2, 0], [16, 9, 0], [16, 9, 8], [16, 2, 8]]",
                               kInward = "[[16, 9, 0], [16, 2, 0], [16, 2, 8], [16, 9, 8]]",
                               kInside = "[[15, 2, 0], [15, 9, 0], [15, 9, 8], [15, 2, 8]]";
    EXPECT_EQ(hiddenBy(kOutward, ""), kFacePosX);
    EXPECT_EQ(hiddenBy(kOutward, ", hidden_by = \"none\""), kFaceCount);
    EXPECT_EQ(hiddenBy(kOutward, ", two_sided = true"), kFaceCount);
    EXPECT_EQ(hiddenBy(kInward, ""), kFaceCount);
    EXPECT_EQ(hiddenBy(kInside, ""), kFaceCount);
    EXPECT_EQ(hiddenBy(kInside, ", hidden_by = \"-z\""), kFaceNegZ);
}

// Bodies and rays meet the boxes, and the one around the quads unless the file gives others.
TEST(ShapeQuads, CollideAsTheBoxAroundThem) {
    const std::string quads = "quads = [{ corners = [[1, 2.5, 3], [9.5, 4, 3], [9, 4, 12], [1, 2.5, 8]] }]";
    const ParsedShape around = parsedShape(quads + "\nboxes = [[0, 0, 0, 16, 16, 1]]");
    ASSERT_EQ(around.form().boxes.size(), 2u);
    EXPECT_TRUE(
        hasBox(around.form(), {1 / 16.0f, 2 / 16.0f, 3 / 16.0f}, {10 / 16.0f, 4 / 16.0f, 12 / 16.0f}));
    const ParsedShape given = parsedShape(quads + "\ncollision = [[0, 0, 0, 16, 8, 16]]");
    ASSERT_EQ(given.form().boxes.size(), 1u);
    EXPECT_TRUE(hasBox(given.form(), {0, 0, 0}, {1, 0.5, 1}));
    const ParsedShape plane =
        parsedShape("quads = [{ corners = [[16, 0, 0], [16, 16, 0], [16, 16, 16], [16, 0, 16]] }]");
    EXPECT_TRUE(hasBox(plane.form(), {15 / 16.0f, 0, 0}, {1, 1, 1})) << "a plane is a sixteenth thick";
}

TEST(ShapeQuads, OtherFormsAndArmsHaveTheirOwn) {
    const std::string quad = "quads = [{ corners = [[4, 8, 0], [12, 8, 0], [12, 8, 8], [4, 8, 8]] }]";
    const ParsedShape shape = parsedShape(fmt::format(
        "boxes = [[6, 6, 0, 10, 10, 4]]\nother = {{ {} }}\narms = {{ boxes = [[7, 10, 0, 9, 16, 4]], {} }}",
        quad, quad));
    EXPECT_EQ(shape.form(0).faces.size(), 6u);
    EXPECT_EQ(shape.form(kStateOther).faces.size(), 1u);
    EXPECT_EQ(shape.form(kStateOther | 1u << 4).faces.size(), 8u) << "quad; box and quad of the arm";
    EXPECT_EQ(shape.form(1u << 4).boxes.size(), 3u);
}

TEST(ShapeQuads, FarTilesShowThemByTheirCollision) {
    constexpr std::string_view kQuad =
        "quads = [{ corners = [[0, 0, 0], [16, 0, 0], [16, 16, 16], [0, 16, 16]] }]\n";
    EXPECT_FALSE(parsedShape(kQuad).blocks.find("b")->model->isBulky) << "a plane";
    EXPECT_TRUE(parsedShape(std::string(kQuad) + "collision = [[0, 0, 0, 16, 16, 8]]")
                    .blocks.find("b")
                    ->model->isBulky);
}

// Each side of a box as a quad: the corners of a face are those of the texture.
TEST(ShapeQuads, ABoxIsSixOfThem) {
    const std::string keys = "facing = true\nhalf = true\n";
    const ParsedShape box = parsedShape(keys + "boxes = [[2, 3, 0, 12, 16, 9]]");
    const ParsedShape quads = parsedShape(keys + R"(quads = [
        { corners = [[2, 16, 0], [2, 3, 0], [2, 3, 9], [2, 16, 9]] },
        { corners = [[12, 3, 0], [12, 16, 0], [12, 16, 9], [12, 3, 9]] },
        { corners = [[2, 3, 0], [12, 3, 0], [12, 3, 9], [2, 3, 9]] },
        { corners = [[12, 16, 0], [2, 16, 0], [2, 16, 9], [12, 16, 9]] },
        { corners = [[2, 16, 0], [12, 16, 0], [12, 3, 0], [2, 3, 0]] },
        { corners = [[2, 3, 9], [12, 3, 9], [12, 16, 9], [2, 16, 9]] },
    ])");
    for (std::uint16_t state = 0; state < 8; ++state) {
        ASSERT_EQ(quads.form(state).faces.size(), 6u);
        for (std::size_t side = 0; side < 6; ++side) {
            const ModelFace& face = box.form(state).faces[side];
            const auto same =
                std::ranges::find(quads.form(state).faces, face.direction, &ModelFace::direction);
            ASSERT_NE(same, quads.form(state).faces.end());
            EXPECT_EQ(same->look, face.look);
            EXPECT_EQ(same->hiddenBy, face.hiddenBy) << state << " " << side;
            const auto number = static_cast<std::size_t>(same - quads.form(state).faces.begin());
            const Corners expected = cornersOf(box.face(side, state));
            EXPECT_THAT(cornersOf(quads.face(number, state)), testing::UnorderedElementsAreArray(expected));
            if (state == 0) {
                EXPECT_EQ(cornersOf(quads.face(number)), expected);
            }
        }
    }
}

std::string shapeErrorOf(std::string_view text) {
    const auto parsed = BlockRegistry::parse(text, "f");
    return parsed ? "" : parsed.error().message;
}

TEST(ShapeParser, TellsWhatIsWrong) {
    EXPECT_EQ(shapeErrorOf("[[shape]]\nname = \"a\"\n"), "f:1: boxes: missing (or quads)");
    EXPECT_EQ(
        shapeErrorOf("[[shape]]\nname = \"a\"\nboxes = [[0, 0, 0, 16, 16, 17]]\n"),
        "f:3: boxes: expected 1 to 16 boxes [x, y, z, x, y, z] in sixteenths of a block, the lower corner "
        "first, got an array of 1");
    EXPECT_EQ(shapeErrorOf("[[shape]]\nname = \"a\"\nboxes = [[0, 0, 0, 16, 16, 16]]\n"),
              "f:1: boxes: fill the whole cell: such a block has the shape cube");
    EXPECT_EQ(shapeErrorOf("[[shape]]\nname = \"cube\"\nboxes = [[0, 0, 0, 16, 16, 1]]\n"),
              "f:2: name: expected a name not used before, got \"cube\"");
    EXPECT_EQ(shapeErrorOf("[[block]]\nname = \"a\"\nshape = \"slope\"\ntexture = \"t\"\nopacity = 1\n"),
              "f:3: shape: expected one of cube, liquid, cross, hash, inset, got \"slope\"");
}

std::string quadErrorOf(std::string_view keys) {
    return shapeErrorOf(fileOf(fmt::format("quads = [{{ {} }}]", keys)));
}

TEST(ShapeParser, TellsWhatIsWrongWithAQuad) {
    constexpr std::string_view kCorners = "corners = [[0, 0, 0], [16, 0, 0], [16, 0, 16], [0, 0, 16]]";
    const auto with = [&](std::string_view keys) {
        return quadErrorOf(fmt::format("{}, {}", kCorners, keys));
    };
    EXPECT_EQ(quadErrorOf(kCorners), "");
    EXPECT_EQ(quadErrorOf("uv = []"), "f:3: quads.corners: missing (required)");
    const std::string range =
        "f:3: quads.corners: expected four corners [x, y, z] from 0 to 16, in sixteenths of a block, got ";
    EXPECT_EQ(quadErrorOf("corners = 3"), range + "3");
    EXPECT_EQ(quadErrorOf("corners = [[0, 0, 0], [16, 0, 0], [16, 0, 16]]"), range + "an array of 3");
    EXPECT_EQ(quadErrorOf("corners = [[0, 0, 0], [16.1, 0, 0], [16, 0, 16], [0, 0, 16]]"),
              range + "an array of 4");
    EXPECT_EQ(quadErrorOf("corners = [[0, 0, 0], [16, 0, nan], [16, 0, 16], [0, 0, 16]]"),
              range + "an array of 4");
    EXPECT_EQ(quadErrorOf("corners = [[0, 0, 0], [16, 0, true], [16, 0, 16], [0, 0, 16]]"),
              range + "an array of 4");
    const std::string area =
        "f:3: quads.corners: expected corners of a convex area, counterclockwise as seen from its front";
    EXPECT_EQ(quadErrorOf("corners = [[0, 0, 0], [16, 0, 0], [16, 0, 0], [0, 0, 0]]"), area) << "a line";
    EXPECT_EQ(quadErrorOf("corners = [[0, 0, 0], [16, 0, 0], [0, 0, 16], [16, 0, 16]]"), area) << "crossed";
    EXPECT_EQ(quadErrorOf("corners = [[0, 0, 0], [16, 0, 0], [3, 0, 3], [0, 0, 16]]"), area) << "a dent";
    EXPECT_EQ(with("uv = [[0, 0], [16, 0], [16, 17], [0, 16]]"),
              "f:3: quads.uv: expected four points [u, v] from 0 to 16, in sixteenths of the texture from "
              "its upper "
              "left corner, got an array of 4");
    EXPECT_EQ(with("texture = \"wick\""),
              "f:3: quads.texture: expected one of top, bottom, side, got \"wick\"");
    EXPECT_EQ(with("two_sided = 1"), "f:3: quads.two_sided: expected true or false, got 1");
    EXPECT_EQ(with("hidden_by = \"up\""),
              "f:3: quads.hidden_by: expected one of none, -x, +x, -y, +y, -z, +z, got \"up\"");
    EXPECT_EQ(with("glow = 1"),
              "f:3: quads.glow: unknown key, expected one of corners, uv, texture, two_sided, hidden_by");
}

TEST(ShapeParser, TellsWhatIsWrongWithAPart) {
    const auto errorOf = [](std::string_view keys) { return shapeErrorOf(fileOf(keys)); };
    EXPECT_EQ(errorOf("quads = []"),
              "f:3: quads: expected 1 to 64 quads { corners = ... }, got an array of 0");
    EXPECT_EQ(errorOf("quads = [3]"),
              "f:3: quads: expected 1 to 64 quads { corners = ... }, got an array of 1");
    std::string many;
    for (int k = 0; k < 65; ++k) many += "{},";
    EXPECT_EQ(errorOf(fmt::format("quads = [{}]", many)),
              "f:3: quads: expected 1 to 64 quads { corners = ... }, got an array of 65");
    EXPECT_EQ(errorOf("boxes = [[0, 0, 0, 1, 1, 1]]\nother = {}"),
              "f:4: other: expected boxes or quads, got a table");
    EXPECT_EQ(errorOf("boxes = [[0, 0, 0, 1, 1, 1]]\narms = { quads = [{ corners = 1 }] }"),
              "f:4: arms.quads.corners: expected four corners [x, y, z] from 0 to 16, in sixteenths of a "
              "block, got 1");
    EXPECT_EQ(errorOf("boxes = [[0, 0, 0, 1, 1, 1]]\narms = { facing = true }"),
              "f:4: arms.facing: unknown key, expected one of boxes, quads, collision");
    EXPECT_EQ(errorOf("boxes = [[0, 0, 0, 1, 1, 1]]\ncollision = [[0, 0, 0, 1, 1, 0]]"),
              "f:4: collision: expected 1 to 16 boxes [x, y, z, x, y, z] in sixteenths of a block, the lower "
              "corner "
              "first, got an array of 1");
}

// The message names the block whose shape does not fit.
TEST(ShapeParser, AllQuadsTogetherAreLimited) {
    const std::string arms = [] {
        std::string quads;
        for (int k = 0; k < 64; ++k)
            quads += fmt::format("{{ corners = [[8, {0}, 0], [9, {0}, 0], [9, {0}, 9], [8, {0}, 9]] }}, ",
                                 k / 8.0);
        return fmt::format("arms = {{ quads = [{}] }}", quads);
    }();
    EXPECT_EQ(
        shapeErrorOf(fileOf("boxes = [[6, 6, 0, 10, 10, 4]]\n" + arms)),
        "f:5: shape: expected at most 1840 different faces in all shapes, 255 faces in each form of one, and "
        "60000 forms and faces in all");
}

}  // namespace
}  // namespace terrane::world
