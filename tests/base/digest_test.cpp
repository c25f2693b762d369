#include "terrane/base/digest.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace terrane::base {
namespace {

std::string digestOf(std::string_view text) {
    Digest digest;
    digest.update(text);
    return digest.hex();
}

// The function as a whole, without the stream.
std::string oneShot(std::string_view text) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(text.data(), text.size()));
    std::string hex;
    for (const unsigned char byte : canonical.digest) hex += fmt::format("{:02x}", byte);
    return hex;
}

std::string someBytes(std::size_t count) {
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(i * i * 31 + i / 7);
    return bytes;
}

TEST(Digest, KnownAnswers) {
    EXPECT_EQ(digestOf(""), "99aa06d3014798d86001c324468d497f");
    EXPECT_EQ(digestOf("abc"), "06b05ab6733a618578af5f94892f3950");
}

TEST(Digest, EqualsTheFunctionAsAWholeAtEveryKindOfLength) {
    for (const std::size_t length : {1u, 3u, 4u, 8u, 9u, 16u, 17u, 128u, 129u, 240u, 241u, 1024u, 5000u}) {
        EXPECT_EQ(digestOf(someBytes(length)), oneShot(someBytes(length))) << length;
    }
}

TEST(Digest, CutsMakeNoDifference) {
    const std::string bytes = someBytes(3000);
    const std::string_view text = bytes;
    for (const std::size_t cut : {0u, 1u, 255u, 256u, 257u, 1500u, 2999u, 3000u}) {
        Digest digest;
        digest.update(text.substr(0, cut));
        digest.update(std::as_bytes(std::span(text.substr(cut))));
        EXPECT_EQ(digest.hex(), digestOf(text)) << cut;
    }
}

TEST(Digest, GoesOnAfterHex) {
    Digest digest;
    digest.update("ab");
    EXPECT_EQ(digest.hex(), digestOf("ab"));
    digest.update("c");
    EXPECT_EQ(digest.hex(), digestOf("abc"));
}

TEST(Digest, Moves) {
    Digest first;
    first.update("ab");
    Digest second = std::move(first);
    second.update("c");
    EXPECT_EQ(second.hex(), digestOf("abc"));
}

// By the specification of xxHash64.
TEST(Hash64, IsFixed) {
    EXPECT_EQ(hash64(""), 0xEF46DB3751D8E999u);
    EXPECT_EQ(hash64("abc"), 0x44BC2CF5AD770999u);
    EXPECT_NE(hash64(std::string_view("a\0", 2)), hash64("a"));
}

TEST(Digest, OneThatWasMovedFromIsOfNoUse) {
    Digest first;
    const Digest second = std::move(first);
    EXPECT_THROW(first.update("bytes"), std::invalid_argument);
    EXPECT_THROW((void)first.hex(), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::base
