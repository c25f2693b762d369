#include "terrane/formats/nbt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace terrane::formats {
namespace {

using testing::HasSubstr;

using Random = std::mt19937;

std::string randomText(Random& random) {
    std::string text(random() % 6, ' ');
    for (char& c : text) c = static_cast<char>(random());
    return text;
}

NbtTag randomTag(Random& random, std::size_t type, int depth);

NbtCompound randomCompound(Random& random, int depth) {
    NbtCompound compound;
    for (std::size_t k = random() % 5; k > 0; --k)
        compound.add(randomText(random), randomTag(random, 1 + random() % (depth > 3 ? 8 : 12), depth));
    return compound;
}

template <class T>
std::vector<T> randomArray(Random& random) {
    std::vector<T> values(random() % 5);
    for (T& value : values) value = static_cast<T>(random());
    return values;
}

NbtList randomList(Random& random, int depth) {
    NbtList list;
    const std::size_t count = random() % 4;
    list.type = static_cast<std::uint8_t>(count == 0 ? 0 : 1 + random() % (depth > 3 ? 8 : 12));
    for (std::size_t k = 0; k < count; ++k) list.tags.push_back(randomTag(random, list.type, depth + 1));
    return list;
}

NbtTag randomTag(Random& random, std::size_t type, int depth) {
    switch (type) {
        case 1:
            return {static_cast<std::int8_t>(random())};
        case 2:
            return {static_cast<std::int16_t>(random())};
        case 3:
            return {static_cast<std::int32_t>(random())};
        case 4:
            return {static_cast<std::int64_t>(random()) << 20};
        case 5:
            return {static_cast<float>(random()) / 3};
        case 6:
            return {static_cast<double>(random()) / -7};
        case 7:
            return {NbtBytes{randomText(random)}};
        case 8:
            return {randomText(random)};
        case 9:
            return {randomList(random, depth + 1)};
        case 10:
            return {randomCompound(random, depth + 1)};
        case 11:
            return {randomArray<std::int32_t>(random)};
        default:
            return {randomArray<std::int64_t>(random)};
    }
}

std::string nbtError(std::string_view bytes) {
    const auto root = decodeNbt(bytes);
    return root ? "" : root.error().message;
}

TEST(Nbt, KnowsTheBytesOfTheFormat) {
    NbtRoot root{"hello world", {}};
    root.compound.add("name", {std::string("Bananrama")}).add("n", {std::int16_t{-2}});
    const std::string bytes(
        "\x0a\0\x0bhello world\x08\0\x04name\0\x09"
        "Bananrama\x02\0\x01n\xff\xfe\0",
        14 + 7 + 11 + 6 + 1);
    EXPECT_EQ(encodeNbt(root), bytes);
    EXPECT_EQ(*decodeNbt(bytes), root);
}

TEST(Nbt, ComesBackTheSameForRandomTrees) {
    Random random(7);
    for (int round = 0; round < 300; ++round) {
        const NbtRoot root{randomText(random), randomCompound(random, 0)};
        const auto back = decodeNbt(encodeNbt(root));
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(*back, root) << "round " << round;
    }
}

TEST(Nbt, RefusesEveryTruncation) {
    Random random(3);
    for (int round = 0; round < 20; ++round) {
        const std::string bytes = encodeNbt({"r", randomCompound(random, 0)});
        for (std::size_t size = 0; size < bytes.size(); ++size)
            ASSERT_THAT(nbtError(bytes.substr(0, size)), HasSubstr("NBT, byte"))
                << size << " of " << bytes.size();
    }
}

TEST(Nbt, FindsTagsByNameAndType) {
    NbtCompound compound;
    compound.add("a", {std::int8_t{3}}).add("b", {std::string("x")}).add("a", {std::int8_t{4}});
    EXPECT_EQ(compound.integer("a"), 3);
    EXPECT_EQ(compound.integer("b"), std::nullopt);
    EXPECT_EQ(compound.get<std::int8_t>("b"), nullptr);
    EXPECT_EQ(*compound.get<std::string>("b"), "x");
    EXPECT_EQ(compound.find("c"), nullptr);
}

TEST(Nbt, RefusesWhatIsDeepOrLarge) {
    std::string deep("\x0a\0\0", 3);
    for (int k = 0; k < 100; ++k) deep += std::string("\x0a\0\0", 3);
    EXPECT_THAT(nbtError(deep), HasSubstr("nested too deep"));
    // Lists with more elements than bytes.
    EXPECT_THAT(nbtError(std::string("\x0a\0\0\x09\0\0\x01\x7f\xff\xff\xff", 11)), HasSubstr("cut off"));
    EXPECT_THAT(nbtError(std::string("\x0a\0\0\x0c\0\0\x10\0\0\0\0\0", 12)), HasSubstr("cut off"));
    EXPECT_THAT(nbtError(std::string("\x0a\0\0\x09\0\0\0\0\0\0\x01\0", 12)),
                HasSubstr("list without a type"));
    EXPECT_THAT(nbtError(std::string("\x0a\0\0\x0d\0\0\0", 7)), HasSubstr("unknown type"));
    EXPECT_THAT(nbtError(std::string("\x08\0\0\0\0", 5)), HasSubstr("expected a compound"));
    // 5 MiB of lists without anything in them.
    std::string many("\x0a\0\0\x09\0\0\x01\0\x50\0\0", 11);
    many += std::string(0x500000, '\0');
    EXPECT_THAT(nbtError(many), HasSubstr("too many tags"));
}

TEST(Nbt, RefusesToWriteWhatTheFormatLacks) {
    NbtRoot root;
    root.compound.add("text", {std::string(65'536, 'a')});
    EXPECT_THROW((void)encodeNbt(root), std::invalid_argument);
    root.compound.entries.clear();
    root.compound.add(std::string(65'536, 'a'), {std::int32_t{1}});
    EXPECT_THROW((void)encodeNbt(root), std::invalid_argument);
    root.compound.entries.clear();
    root.compound.add("list", {NbtList{3, {{std::int32_t{1}}, {std::string("two")}}}});
    EXPECT_THROW((void)encodeNbt(root), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::formats
