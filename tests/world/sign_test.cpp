#include "terrane/world/blocks/sign.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "terrane/world/blocks/block_model.h"
#include "tests/world/content_blocks.h"

namespace terrane::world {
namespace {

TEST(Sign, TextComesBackTheSame) {
    const SignText text{"Grüße", "", "žluťoučký kůň", "日本語 🌳"};
    ASSERT_TRUE(checkSign(text));
    const auto back = decodeSign(encodeSign(text));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, text);
    SignText large;
    for (std::string& line : large)
        for (std::size_t n = 0; n < kSignColumns; ++n) line += "🌳";
    EXPECT_EQ(encodeSign(large).size(), kMaxSignBytes);
    EXPECT_EQ(*decodeSign(encodeSign(large)), large);
}

TEST(Sign, WrongTextsAreRefused) {
    EXPECT_TRUE(checkSign({std::string(24, 'a'), "", "", ""}));
    EXPECT_FALSE(checkSign({std::string(25, 'a'), "", "", ""}));
    for (const char* line : {"a\tb", "a\x1b[31m", "\xc2\x9b", "\xff", "\xc3", "\xc0\xaf", "\xed\xa0\x80",
                             "\xf4\x90\x80\x80", "\xe2\x82"})
        EXPECT_FALSE(checkSign({"", line, "", ""})) << line;
}

TEST(Sign, AnyBytesAreATextOrAnError) {
    EXPECT_FALSE(decodeSign({}));
    EXPECT_FALSE(decodeSign(BlockEntityData(kMaxSignBytes + 1, std::byte{1})));
    const BlockEntityData whole = encodeSign({"one", "two", "three", "Ж"});
    for (unsigned bit = 0; bit < 8 * whole.size(); ++bit) {
        BlockEntityData flipped = whole;
        flipped[bit / 8] ^= std::byte(1u << bit % 8);
        const auto text = decodeSign(flipped);
        EXPECT_TRUE(!text || encodeSign(*text) == flipped);
    }
    BlockEntityData lines = encodeSign({});
    EXPECT_TRUE(decodeSign(lines));
    lines.push_back(std::byte{'\n'});
    EXPECT_FALSE(decodeSign(lines)) << "five lines";
}

TEST(Sign, OnlySignsHoldText) {
    EXPECT_TRUE(isSign(contentBlocks().type(contentBlock("sign"))));
    EXPECT_FALSE(isSign(contentBlocks().type(contentBlock("chest"))));
    EXPECT_FALSE(signPlane(contentBlocks().type(contentBlock("stone")), 0));
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z;
}

// Standing, with the face at -y; then turned a quarter; then at the wall at +y.
TEST(Sign, ThePlaneIsTheFrontOfTheBoard) {
    const BlockType& type = contentBlocks().type(contentBlock("sign"));
    const SignPlane standing = *signPlane(type, 0);
    expectNear(standing.normal, {0, -1, 0});
    expectNear(standing.right, {1, 0, 0});
    expectNear(standing.topLeft, {0, 7 / 16.0, 1});
    EXPECT_LT(standing.down.z, -0.5);
    const SignPlane turned = *signPlane(type, 1);
    expectNear(turned.normal, {1, 0, 0});
    expectNear(turned.right, {0, 1, 0});
    expectNear(turned.topLeft, {9 / 16.0, 0, 1});
    const SignPlane onWall = *signPlane(type, kStateOther);
    expectNear(onWall.normal, {0, -1, 0});
    expectNear(onWall.topLeft, {0, 14 / 16.0, 14 / 16.0});
    for (std::uint16_t state = 0; state < 16; ++state) {
        const SignPlane plane = *signPlane(type, state);
        expectNear(glm::cross(plane.right, -plane.down) / glm::length(plane.down), plane.normal);
    }
}

TEST(Sign, LinesStayOnTheBoardAndApart) {
    const SignPlane plane = *signPlane(contentBlocks().type(contentBlock("sign")), 0);
    for (const double aspect : {0.0, 1.0, 5.0, 13.0, 60.0}) {
        double end = 0;
        for (std::size_t line = 0; line < kSignLines; ++line) {
            const SignLine at = lineOn(plane, line, aspect);
            EXPECT_GT(at.height, 0);
            EXPECT_GE(at.left, 0.05);
            EXPECT_LE(at.left + aspect * at.height, glm::length(plane.right) - 0.05);
            EXPECT_GE(at.top, end);
            end = at.top + at.height;
            EXPECT_NEAR(at.left + aspect * at.height / 2, glm::length(plane.right) / 2, 1e-9);
        }
        EXPECT_LE(end, glm::length(plane.down));
    }
}

TEST(Sign, TypingStopsWhereALineIsFull) {
    EXPECT_EQ(fittingBytes("hello"), 5u);
    EXPECT_EQ(fittingBytes(std::string(30, 'a')), kSignColumns);
    std::string wide;
    for (int n = 0; n < 30; ++n) wide += "ž";
    EXPECT_EQ(fittingBytes(wide), 2 * kSignColumns);
}

TEST(Sign, AWrongTextIsNotEncoded) {
    EXPECT_THROW(encodeSign({"a\nb", "", "", ""}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::world
