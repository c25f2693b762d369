#include "terrane/store/chunks/structure_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <fstream>
#include <random>

#include "terrane/base/files.h"
#include "terrane/store/chunks/bytes.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;
using world::Structure;

Structure randomStructure(std::mt19937& random) {
    Structure structure;
    structure.size = {1 + static_cast<int>(random() % 9), 1 + static_cast<int>(random() % 9),
                      1 + static_cast<int>(random() % 9)};
    const auto count = static_cast<std::uint32_t>(structure.blockCount());
    const std::uint32_t different = 1 + static_cast<std::uint32_t>(random()) % std::min(count, 300u);
    for (std::uint32_t n = 0; n < different; ++n)
        structure.palette.push_back({"b" + std::to_string(n / 2), static_cast<std::uint16_t>(n)});
    for (std::uint32_t cell = 0; cell < count; ++cell) {
        structure.cells.push_back(static_cast<std::uint32_t>(random()) % different);
        if (random() % 7 == 0)
            structure.data.push_back(
                {cell, std::make_shared<const world::BlockEntityData>(random() % 40, std::byte{5})});
    }
    return structure;
}

// The frame of docs/structure-format.md.
Bytes framed(ByteView plain, std::uint8_t version = 1, std::uint32_t size = 0) {
    Bytes rest, out;
    appendNumber(rest, version);
    appendNumber(rest, size != 0 ? size : static_cast<std::uint32_t>(plain.size()));
    appendCompressed(rest, plain);
    append(out, std::as_bytes(std::span("TerrStru", 8)));
    appendNumber(out, std::uint64_t{XXH64(rest.data(), rest.size(), 0)});
    append(out, rest);
    return out;
}

Bytes content(int x, int y, int z, std::uint32_t palette) {
    Bytes bytes;
    for (const int size : {x, y, z}) appendNumber(bytes, static_cast<std::uint16_t>(size));
    appendNumber(bytes, palette);
    return bytes;
}

void appendBlock(Bytes& bytes, std::string_view name, std::uint16_t state = 0) {
    appendNumber(bytes, static_cast<std::uint8_t>(name.size()));
    append(bytes, std::as_bytes(std::span(name)));
    appendNumber(bytes, state);
}

std::string fileError(ByteView bytes) {
    const auto structure = decodeStructure(bytes);
    return structure ? "" : structure.error().message;
}

TEST(StructureFile, ComesBackTheSame) {
    std::mt19937 random(1);
    for (int round = 0; round < 100; ++round) {
        const Structure structure = randomStructure(random);
        const auto bytes = encodeStructure(structure);
        ASSERT_TRUE(bytes) << bytes.error().message;
        const auto back = decodeStructure(*bytes);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_TRUE(*back == structure);
        EXPECT_EQ(*encodeStructure(*back), *bytes);
    }
}

TEST(StructureFile, AsHighAsTheHighestWorld) {
    Structure structure;
    structure.size = {3, 2, 4096};
    structure.palette.push_back({"stone", 0});
    structure.palette.push_back({"sand", 5});
    for (std::int64_t cell = 0; cell < structure.blockCount(); ++cell)
        structure.cells.push_back(static_cast<std::uint32_t>(cell % 7 == 0));
    const auto bytes = encodeStructure(structure);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(decodeStructure(*bytes).value(), structure);
    structure.size = {3, 1, 4097};
    EXPECT_FALSE(encodeStructure(structure));
}

// Version 1, byte by byte: two blocks, a stone and a sign that says "hi".
TEST(StructureFile, ReadsThePageOfTheFormat) {
    Bytes bytes = content(2, 1, 1, 2);
    appendBlock(bytes, "stone");
    appendBlock(bytes, "sign", 9);
    for (const std::uint8_t cell : {0, 1}) appendNumber(bytes, cell);
    appendNumber(bytes, std::uint32_t{1});
    appendNumber(bytes, std::uint32_t{1});
    appendNumber(bytes, std::uint32_t{3});
    append(bytes, std::as_bytes(std::span("\1hi", 3)));
    const auto structure = decodeStructure(framed(bytes));
    ASSERT_TRUE(structure) << structure.error().message;
    EXPECT_EQ(structure->size, glm::ivec3(2, 1, 1));
    EXPECT_EQ(structure->palette[1], (world::StructureBlock{"sign", 9}));
    ASSERT_EQ(structure->data.size(), 1u);
    EXPECT_EQ(structure->data[0].cell, 1u);
    EXPECT_EQ(structure->data[0].data->size(), 3u);
    EXPECT_EQ(*encodeStructure(*structure), framed(bytes));
}

TEST(StructureFile, UnpacksNoMoreThanTheCallerAllows) {
    Structure structure;
    structure.size = {100, 100, 50};
    structure.palette = {{"stone", 0}};
    structure.cells.assign(500'000, 0);
    const Bytes bytes = encodeStructure(structure).value();
    EXPECT_LT(bytes.size(), 1000u);
    EXPECT_TRUE(decodeStructure(bytes, 510'000));
    const auto refused = decodeStructure(bytes, 500'000);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("expected at most 500000"));
}

TEST(StructureFile, EveryTruncationAndFlippedBitIsAnError) {
    std::mt19937 random(2);
    const Bytes whole = *encodeStructure(randomStructure(random));
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(fileError(ByteView(whole).first(length)), "") << length;
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        Bytes flipped = whole;
        flipped[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        EXPECT_NE(fileError(flipped), "") << bit;
    }
}

// With a valid checksum.
TEST(StructureFile, EveryTruncationOfTheContentIsAnError) {
    Bytes bytes = content(2, 1, 1, 1);
    appendBlock(bytes, "stone");
    for (const std::uint8_t cell : {0, 0}) appendNumber(bytes, cell);
    appendNumber(bytes, std::uint32_t{1});
    appendNumber(bytes, std::uint64_t{1} | std::uint64_t{2} << 32);
    appendNumber(bytes, std::uint16_t{7});
    ASSERT_EQ(fileError(framed(bytes)), "");
    for (std::size_t length = 0; length < bytes.size(); ++length)
        EXPECT_NE(fileError(framed(ByteView(bytes).first(length))), "") << length;
    bytes.push_back(std::byte{0});
    EXPECT_THAT(fileError(framed(bytes)), HasSubstr("1 bytes too many"));
}

TEST(StructureFile, SaysWhatIsWrong) {
    EXPECT_THAT(fileError({}), HasSubstr("not a structure"));
    EXPECT_THAT(fileError(framed(content(1, 1, 1, 1), 2)), HasSubstr("version 2"));
    EXPECT_THAT(fileError(framed(content(1, 1, 1, 1), 1, 1u << 30)), HasSubstr("1073741824"));
    EXPECT_THAT(fileError(framed(content(0, 1, 1, 1))), HasSubstr("0 × 1 × 1"));
    EXPECT_THAT(fileError(framed(content(1, 0, 1, 1))), HasSubstr("1 × 0 × 1"));
    EXPECT_THAT(fileError(framed(content(1, 1, 0, 1))), HasSubstr("1 × 1 × 0"));
    EXPECT_THAT(fileError(framed(content(1, 1, 4097, 1))), HasSubstr("4097"));
    EXPECT_THAT(fileError(framed(content(65535, 65535, 1, 1))), HasSubstr("at most 500000"));
    EXPECT_THAT(fileError(framed(content(1, 1, 1, 2))), HasSubstr("2 entries"));
    Bytes named = content(1, 1, 1, 1);
    appendBlock(named, "a\nb");
    EXPECT_THAT(fileError(framed(named)), HasSubstr("not a name of a block"));
    Bytes beyond = content(1, 1, 1, 1);
    appendBlock(beyond, "stone");
    appendNumber(beyond, std::uint8_t{1});
    EXPECT_THAT(fileError(framed(beyond)), HasSubstr("palette of 1"));
}

TEST(StructureFile, BlocksOfPacksHaveTheNameOfTheirPack) {
    Structure structure{.size = {1, 1, 1}, .palette = {{"isles:glow_rock", 2}}, .cells = {0}, .data = {}};
    const auto bytes = encodeStructure(structure);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(decodeStructure(*bytes)->palette, structure.palette);
    for (const char* name : {":rock", "isles:", "isles:a:b", "isles :rock", ":"}) {
        structure.palette[0].name = name;
        EXPECT_FALSE(encodeStructure(structure)) << name;
    }
}

TEST(StructureFile, TooMuchForAFileIsRefused) {
    Structure structure{.size = {1, 1, 1}, .palette = {{"chest", 0}}, .cells = {0}, .data = {}};
    structure.data.push_back({0, std::make_shared<const world::BlockEntityData>(kMaxStructureDataBytes + 1)});
    EXPECT_FALSE(encodeStructure(structure));
    EXPECT_FALSE(encodeStructure(Structure{})) << "there is nothing";
}

TEST(StructureFile, LiesInAFolder) {
    const auto folder = base::TemporaryFolder::make(testing::TempDir(), "structures");
    ASSERT_TRUE(folder);
    const std::filesystem::path place = folder->path() / "structures";
    EXPECT_TRUE(structureNames(place).empty());
    std::mt19937 random(3);
    const Structure structure = randomStructure(random);
    for (const char* name : {"tower", "my house"})
        ASSERT_TRUE(writeStructure(*structurePath(place, name), structure));
    std::ofstream(place / "notes.txt") << "x";
    std::ofstream(place / "bad.structure") << "x";
    EXPECT_EQ(structureNames(place), (std::vector<std::string>{"bad", "my house", "tower"}));
    EXPECT_TRUE(*readStructure(*structurePath(place, "tower")) == structure);
    const auto bad = readStructure(*structurePath(place, "bad"));
    ASSERT_FALSE(bad);
    EXPECT_THAT(bad.error().message, HasSubstr("bad.structure: it is not a structure"));
    EXPECT_FALSE(readStructure(*structurePath(place, "absent")));
    for (const char* name : {"", "../x", "a/b", ".hidden", "a\nb"}) EXPECT_FALSE(structurePath(place, name));
}

}  // namespace
}  // namespace terrane::store
