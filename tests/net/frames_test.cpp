#include "terrane/net/wire/wire.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/net/bytes_of.h"

namespace terrane::net {
namespace {

TEST(Frames, MessagesComeBackHoweverTheyAreCut) {
    std::mt19937 random(1);
    Bytes stream;
    std::vector<Bytes> messages;
    for (const std::size_t size : {0, 1, 127, 128, 16383, 16384, 65536}) {
        messages.emplace_back(size);
        for (std::byte& byte : messages.back()) byte = static_cast<std::byte>(random());
        appendFrame(stream, messages.back());
    }
    for (const std::size_t most : {1u, 3u, 5000u, 1000000u}) {
        FrameReader reader(65536);
        std::vector<Bytes> found;
        for (ByteView rest = stream; !rest.empty();) {
            const std::size_t count = std::min(rest.size(), 1 + random() % most);
            reader.add(rest.first(count));
            rest = rest.subspan(count);
            while (const auto frame = reader.next().value()) found.emplace_back(frame->begin(), frame->end());
        }
        EXPECT_EQ(found, messages);
        EXPECT_EQ(reader.waitingBytes(), 0u);
    }
}

TEST(Frames, LengthsThatAreTooLargeAreErrors) {
    for (const Bytes& stream : {bytesOf({0x81, 0x80, 0x04}), bytesOf({0xff, 0xff, 0xff, 0xff}),
                                bytesOf({0x80, 0x80, 0x80, 0x80, 0x00}), Bytes(100, std::byte{0x80})}) {
        FrameReader reader(65536);
        reader.add(stream);
        EXPECT_FALSE(reader.next());
    }
    FrameReader reader(65536);
    reader.add(bytesOf({0x80, 0x80, 0x04}));
    EXPECT_TRUE(reader.next()) << "65,536 bytes are yet to come";
}

TEST(Frames, LengthsHaveTheirShortestForm) {
    for (const Bytes& stream : {bytesOf({0x80, 0x00}), bytesOf({0x85, 0x80, 0x00})}) {
        FrameReader reader(65536);
        reader.add(stream);
        EXPECT_FALSE(reader.next());
    }
    FrameReader reader(65536);
    reader.add(bytesOf({0x00}));
    const auto empty = reader.next();
    ASSERT_TRUE(empty && empty->has_value());
    EXPECT_EQ((*empty)->size(), 0u);
}

}  // namespace
}  // namespace terrane::net
