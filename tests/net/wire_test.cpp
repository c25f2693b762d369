#include "terrane/net/wire/wire.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>

#include "tests/net/bytes_of.h"

namespace terrane::net {
namespace {

template <class Write>
Bytes written(Write write) {
    Bytes bytes;
    WireWriter wire(bytes);
    write(wire);
    return bytes;
}

TEST(Wire, NumbersTakeAsManyBytesAsTheyNeed) {
    EXPECT_EQ(written([](auto& wire) { wire.number(0); }), bytesOf({0}));
    EXPECT_EQ(written([](auto& wire) { wire.number(127); }), bytesOf({127}));
    EXPECT_EQ(written([](auto& wire) { wire.number(300); }), bytesOf({0xAC, 2}));
    EXPECT_EQ(written([](auto& wire) { wire.integer(-1); }), bytesOf({1}));
    EXPECT_EQ(written([](auto& wire) { wire.integer(64); }), bytesOf({0x80, 1}));
    EXPECT_EQ(written([](auto& wire) { wire.number(~std::uint64_t{0}); }).size(), kMaxVarintBytes);
    EXPECT_EQ(written([](auto& wire) { wire.fixed(std::uint32_t{0x01020304}); }), bytesOf({4, 3, 2, 1}));
}

TEST(Wire, EveryNumberReadsBack) {
    std::mt19937_64 random(1);
    for (int k = 0; k < 2000; ++k) {
        const std::uint64_t value = random() >> random() % 64;
        const auto integer = static_cast<std::int64_t>(random()) >> random() % 64;
        const Bytes bytes = written([&](auto& wire) {
            wire.number(value);
            wire.integer(integer);
        });
        WireReader reader(bytes);
        std::uint64_t read = 0;
        std::int64_t readInteger = 0;
        reader.number(read);
        reader.integer(readInteger);
        EXPECT_TRUE(reader.isComplete());
        EXPECT_EQ(read, value);
        EXPECT_EQ(readInteger, integer);
    }
    for (const std::int64_t end :
         {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
        EXPECT_EQ(unzigzag(zigzag(end)), end);
}

TEST(Wire, ANumberHasOneFormAndFitsItsType) {
    const auto isRead = [](const Bytes& bytes, auto value) {
        WireReader reader(bytes);
        reader.number(value);
        return reader.isComplete();
    };
    EXPECT_TRUE(isRead(bytesOf({0xFF, 1}), std::uint8_t{}));
    EXPECT_FALSE(isRead(bytesOf({0x80, 2}), std::uint8_t{})) << "256";
    EXPECT_FALSE(isRead(bytesOf({0x81, 0}), std::uint32_t{})) << "1 in two bytes";
    EXPECT_FALSE(isRead(bytesOf({0x80}), std::uint32_t{})) << "cut off";
    Bytes long64 = bytesOf({0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 1});
    EXPECT_TRUE(isRead(long64, std::uint64_t{}));
    long64.back() = std::byte{2};
    EXPECT_FALSE(isRead(long64, std::uint64_t{})) << "65 bits";
}

TEST(Wire, FlagsAndChoicesAreWhatTheyMayBe) {
    enum class Color : std::uint8_t { Red, Green, Count };
    for (int byte = 0; byte < 4; ++byte) {
        const Bytes bytes = bytesOf({byte});
        WireReader flags(bytes), choices(bytes);
        bool flag = false;
        Color color{};
        flags.flag(flag);
        choices.choice(color, Color::Count);
        EXPECT_EQ(flags.isComplete(), byte < 2);
        EXPECT_EQ(choices.isComplete(), byte < 2);
        EXPECT_EQ(static_cast<int>(color), byte < 2 ? byte : 0);
    }
}

TEST(Wire, TextIsPlainAndNotTooLong) {
    const auto isRead = [](const std::string& text, std::size_t most) {
        const Bytes bytes = written([&](auto& wire) { wire.text(text, most); });
        WireReader reader(bytes);
        std::string read;
        reader.text(read, most);
        return reader.isComplete() && read == text;
    };
    EXPECT_TRUE(isRead("", 0));
    EXPECT_TRUE(isRead("žluťoučký", 20));
    EXPECT_FALSE(isRead("abc", 2));
    EXPECT_FALSE(isRead("a\nb", 10));
    EXPECT_FALSE(isRead("\x1B[31m", 10));
    EXPECT_FALSE(isRead("\xC3", 10));
    EXPECT_FALSE(isRead("\u202Eabc", 10)) << "turns what follows around";
}

TEST(Wire, ListsThatPromiseMoreThanThereIsAreRefused) {
    const Bytes bytes = bytesOf({0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 1, 2, 3});  // 2^32 - 1 values
    WireReader reader(bytes);
    std::vector<std::uint8_t> values;
    reader.list(values, std::numeric_limits<std::size_t>::max(),
                [&](std::uint8_t& value) { reader.fixed(value); });
    EXPECT_TRUE(reader.hasFailed());
    EXPECT_TRUE(values.empty());
}

}  // namespace
}  // namespace terrane::net
