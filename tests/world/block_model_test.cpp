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
    for (const ModelFace& face : formOf("oak_stairs", 0).faces) (face.isOnBorder ? onBorder : inside)++;
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
    const BlockRegistry far = blocks().seenFromAfar();
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

std::string shapeErrorOf(std::string_view text) {
    const auto parsed = BlockRegistry::parse(text, "f");
    return parsed ? "" : parsed.error().message;
}

TEST(ShapeParser, TellsWhatIsWrong) {
    EXPECT_EQ(shapeErrorOf("[[shape]]\nname = \"a\"\n"), "f:1: boxes: missing (required)");
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

}  // namespace
}  // namespace terrane::world
