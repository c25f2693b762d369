#include "terrane/store/chunks/chunk_codec.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <xxhash.h>

#include "terrane/store/chunks/bytes.h"
#include "tests/store/store_fixture.h"
#include "tests/support/default_heights.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;
using world::Chunk;
using world::Section;

Bytes encode(const Chunk& chunk, const BlockIdMap& ids = allIds()) {
    auto bytes = encodeChunk(chunk, ids);
    EXPECT_TRUE(bytes) << bytes.error().message;
    return std::move(*bytes);
}

// The reader's error for bytes with a valid checksum.
std::string errorOf(const Bytes& bytes, world::Heights heights = {}) {
    const auto chunk = decodeChunk(bytes, allIds(), heights);
    return chunk ? "" : chunk.error().message;
}

Bytes withChecksum(Bytes bytes) {
    const std::uint64_t sum = XXH64(bytes.data() + 8, bytes.size() - 8, 0);
    std::memcpy(bytes.data(), &sum, sizeof sum);
    return bytes;
}

// The frame of docs/file-format.md around any content.
Bytes frame(ByteView plain, std::uint8_t version = kLowChunkVersion) {
    Bytes bytes(8);
    appendNumber(bytes, version);
    appendNumber(bytes, static_cast<std::uint32_t>(plain.size()));
    appendCompressed(bytes, plain);
    return withChecksum(bytes);
}

// The content of an encoded chunk, without header and compression.
Bytes contentOf(const Bytes& encoded) {
    std::uint32_t length = 0;
    std::memcpy(&length, encoded.data() + 9, sizeof length);
    Bytes plain(length);
    EXPECT_TRUE(decompress(ByteView(encoded).subspan(13), plain));
    return plain;
}

// Uniform sections of id 0 and block state 0, then `rest`.
Bytes plainAir(ByteView rest) {
    Bytes plain(32 * 3);
    append(plain, rest);
    return plain;
}

TEST(ChunkCodec, RandomChunksComeBack) {
    std::mt19937 random(1);
    for (int round = 0; round < 100; ++round) {
        const Chunk chunk = randomChunk(random);
        const auto back = decodeChunk(encode(chunk), allIds(), {});
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(*back, chunk);
    }
}

// Independent of history: sections wider than needed, palettes in another order.
TEST(ChunkCodec, EqualChunksGiveEqualBytes) {
    std::mt19937 random(2);
    for (int round = 0; round < 20; ++round) {
        const Chunk chunk = randomChunk(random);
        Chunk detour = chunk;
        for (int step = 0; step < 400; ++step) {
            const auto i = randomIndex(random);
            if (chunk.blockEntityData(i)) continue;
            detour.setBlock(i, static_cast<world::BlockId>(random()));
            if (step % 8 == 0) detour.setBlockEntityData(i, randomBytes(random, 3));
        }
        for (int i = 0; i < world::kBlocksPerChunk; ++i) {
            const auto index = static_cast<world::BlockIndex>(i);
            if (chunk.blockEntityData(index)) continue;
            if (detour.block(index) != chunk.block(index)) detour.setBlock(index, chunk.block(index));
            detour.setBlockState(index, chunk.blockState(index));
        }
        ASSERT_EQ(detour, chunk);
        ASSERT_EQ(encode(detour), encode(chunk));
        ASSERT_EQ(encode(*decodeChunk(encode(chunk), allIds(), {})), encode(chunk));
    }
}

TEST(ChunkCodec, EmptyChunkIsSmall) {
    EXPECT_LT(encode(Chunk()).size(), 40u);
}

TEST(ChunkCodec, EveryBlockWithBlockEntityData) {
    Chunk chunk;
    for (int i = 0; i < world::kBlocksPerChunk; ++i)
        chunk.setBlockEntityData(static_cast<world::BlockIndex>(i), world::BlockEntityData(2, std::byte(i)));
    const auto back = decodeChunk(encode(chunk), allIds(), {});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, chunk);
}

TEST(ChunkCodec, TooMuchBlockEntityDataIsRefused) {
    Chunk chunk;
    chunk.setBlockEntityData(5, world::BlockEntityData(30u << 20));
    EXPECT_TRUE(encodeChunk(chunk, allIds()));
    chunk.setBlockEntityData(6, world::BlockEntityData(33u << 20));
    const auto bytes = encodeChunk(chunk, allIds());
    ASSERT_FALSE(bytes);
    EXPECT_THAT(bytes.error().message, HasSubstr("block entity data"));
}

// A save of a build with other ids, and with blocks that this one lacks.
TEST(ChunkCodec, IdsFollowTheNames) {
    const auto writer = BlockIdMap::make(registryOf({"stone", "lamp", "dirt"}), {});
    ASSERT_TRUE(writer);
    Chunk chunk;
    chunk.setSection(0, Section(1));
    chunk.setBlock(3, 2);
    chunk.setBlock(4, 3);
    const Bytes bytes = encode(chunk, *writer);

    const auto registry = registryOf({"dirt", "sand", "stone"});
    const auto reader = BlockIdMap::make(registry, writer->added());
    ASSERT_TRUE(reader);
    const auto seen = decodeChunk(bytes, *reader, {});
    ASSERT_TRUE(seen) << seen.error().message;
    EXPECT_EQ(seen->block(0), registry.find("stone")->id);
    EXPECT_EQ(seen->block(4), registry.find("dirt")->id);
    EXPECT_GE(seen->block(3), registry.types().size());
    EXPECT_EQ(registry.type(seen->block(3)).name, "missing");
    EXPECT_EQ(encode(*seen, *reader), bytes) << "the unknown block goes back under its own id";
}

TEST(ChunkCodec, DenseSectionsAreMappedToo) {
    std::mt19937 random(3);
    std::vector<SavedName> saved = {{9, "air"}, {8, "missing"}};
    for (int id = 100; id < 700; ++id)
        saved.push_back({static_cast<world::BlockId>(id), "b" + std::to_string(id)});
    const auto ids = BlockIdMap::make(registryOf({"stone"}), saved);
    ASSERT_TRUE(ids);
    std::array<Section::Value, world::kBlocksPerSection> values;
    for (auto& value : values) value = static_cast<Section::Value>(random() % 600);
    Chunk chunk;
    chunk.setSection(7, Section::fromValues(values));
    ASSERT_TRUE(chunk.section(7).isDense());
    const auto back = decodeChunk(encode(chunk, *ids), *ids, {});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, chunk);
}

TEST(ChunkCodec, IdsWithoutNamesAreErrors) {
    const auto few = BlockIdMap::make(registryOf({"stone"}), {});
    Chunk chunk;
    chunk.setBlock(1, 77);
    const auto bytes = encodeChunk(chunk, *few);
    ASSERT_FALSE(bytes);
    EXPECT_THAT(bytes.error().message, HasSubstr("77"));
    const auto back = decodeChunk(encode(chunk), *few, {});
    ASSERT_FALSE(back);
    EXPECT_THAT(back.error().message, HasSubstr("block id 77 has no name"));
}

// Written by the first release of the format: must stay readable.
TEST(ChunkCodec, ReadsVersion1) {
    constexpr std::string_view kHex =
        "0ed4fe921733ae79019812000028b52ffd0018cd0300d2061522902bad01a7faffffffff4ff52f7177d18757cb"
        "abaaaab065031bd8103776237bcb1419ccd534fd6a224a0f0da38584d041c1671bc8023a57f5dee6ea5e5a5652"
        "4e46423e3a36322e2a4aa3d027bb9e6827f906161000962a9ea5c7820f372cf870c3820f372cf870c3820f372c"
        "f8708ba5563c34a1";
    Bytes bytes;
    for (std::size_t i = 0; i < kHex.size(); i += 2)
        bytes.push_back(static_cast<std::byte>(std::stoi(std::string(kHex.substr(i, 2)), nullptr, 16)));
    Chunk expected;
    expected.setSection(0, Section(1));
    expected.setSection(1, Section(300));
    for (int i = 0; i < 20; ++i)
        expected.setBlock(static_cast<world::BlockIndex>(9000 + 7 * i), static_cast<world::BlockId>(i * 3));
    expected.setBlockState(9007, 500);
    expected.setBlockEntityData(65535, {std::byte{'a'}, std::byte{'b'}});
    const auto chunk = decodeChunk(bytes, allIds(), {});
    ASSERT_TRUE(chunk) << chunk.error().message;
    EXPECT_EQ(*chunk, expected);
}

TEST(ChunkCodec, SaysWhatIsWrong) {
    const Bytes noLarge(4);
    EXPECT_EQ(errorOf(frame(plainAir(noLarge))), "");
    EXPECT_THAT(errorOf({}), HasSubstr("too few"));
    EXPECT_THAT(errorOf(Bytes(12)), HasSubstr("too few"));
    EXPECT_THAT(errorOf(Bytes(40)), HasSubstr("checksum"));
    EXPECT_THAT(errorOf(frame(plainAir(noLarge), 2)), HasSubstr("chunk version 2"));
    EXPECT_THAT(errorOf(frame(plainAir({}))), HasSubstr("ends too early"));
    EXPECT_THAT(errorOf(frame(plainAir(Bytes(5)))), HasSubstr("1 bytes too many"));
    EXPECT_THAT(errorOf(frame(Bytes(10, std::byte{3}))), HasSubstr("3 bits"));
    EXPECT_THAT(errorOf(frame(Bytes(10, std::byte{1}))), HasSubstr("palette of 257"));
    Bytes large;
    appendNumber(large, std::uint32_t{70000});
    EXPECT_THAT(errorOf(frame(plainAir(large))), HasSubstr("70000 blocks"));
}

TEST(ChunkCodec, BlockEntityDataOutOfOrderIsRefused) {
    Bytes large;
    appendNumber(large, std::uint32_t{2});
    for (const int index : {5, 5}) {
        appendNumber(large, static_cast<std::uint16_t>(index));
        appendNumber(large, std::uint32_t{0});
    }
    EXPECT_THAT(errorOf(frame(plainAir(large))), HasSubstr("out of order"));
}

TEST(ChunkCodec, PaletteThatDoesNotFitIsRefused) {
    Bytes plain;
    appendNumber(plain, std::uint8_t{2});
    appendNumber(plain, std::uint16_t{3});
    for (const int id : {1, 2, 3}) appendNumber(plain, static_cast<std::uint16_t>(id));
    plain.resize(plain.size() + 31 * 3);
    plain.resize(plain.size() + 1024, std::byte{0xFF});  // palette index 3 everywhere
    appendNumber(plain, std::uint32_t{0});
    EXPECT_THAT(errorOf(frame(plain)), HasSubstr("palette of 2 bits"));
}

// Wrong lengths are detected, without excessive allocations.
TEST(ChunkCodec, LyingLengths) {
    Bytes bytes = frame(plainAir(Bytes(4)));
    for (const std::uint32_t length : {0u, 1u, 99u, 101u, 1u << 26, (1u << 26) + 1, 0xFFFFFFFFu}) {
        std::memcpy(bytes.data() + 9, &length, sizeof length);
        EXPECT_NE(errorOf(withChecksum(bytes)), "") << length;
    }
}

// Damaged bytes never crash the reader (checked by the sanitizers). Half of the changes are made inside the
// checksum and the compression.
TEST(ChunkCodec, DamagedBytes) {
    std::mt19937 random(4);
    for (int round = 0; round < 40; ++round) {
        const Bytes good = encode(randomChunk(random));
        for (int step = 0; step < 40; ++step) {
            Bytes bad = good;
            bad[random() % bad.size()] ^= static_cast<std::byte>(1u << random() % 8);
            EXPECT_THAT(errorOf(bad), HasSubstr("checksum"));
            (void)errorOf(withChecksum(bad));
            bad.resize(random() % good.size());
            EXPECT_NE(errorOf(bad), "");
            bad.resize(std::max<std::size_t>(bad.size(), 8));
            EXPECT_NE(errorOf(withChecksum(bad)), "");
        }
    }
}

TEST(ChunkCodec, DamagedContent) {
    std::mt19937 random(5);
    for (int round = 0; round < 30; ++round) {
        const Bytes good = encode(randomChunk(random));
        const Bytes plain = contentOf(good);
        for (int step = 0; step < 30; ++step) {
            Bytes bad = plain;
            // The interesting parts are at both ends: section heads, and lengths of block entity data.
            const std::size_t near = random() % std::min<std::size_t>(bad.size(), 300);
            bad[random() % 2 ? near : bad.size() - 1 - near] = static_cast<std::byte>(random());
            (void)errorOf(frame(bad));
            bad.resize(random() % plain.size());
            EXPECT_NE(errorOf(frame(bad)), "") << "cut off";
        }
    }
}

Bytes tallFrame(ByteView plain) {
    return frame(plain, kTallChunkVersion);
}

// The beginning of the content of a tall chunk, then runs of uniform sections of these lengths.
Bytes plainTall(world::Heights heights, const std::vector<int>& runs, ByteView rest = {}) {
    Bytes plain;
    appendNumber(plain, static_cast<std::int16_t>(heights.bottom));
    appendNumber(plain, static_cast<std::int16_t>(heights.top));
    for (const int sections : runs) {
        appendNumber(plain, static_cast<std::uint8_t>(sections - 1));
        appendNumber(plain, std::uint8_t{0});
        appendNumber(plain, std::uint16_t{0});
    }
    append(plain, rest);
    return plain;
}

// Against plain arrays that are written block by block.
TEST(TallChunkCodec, RandomBlocksComeBack) {
    std::mt19937 random(11);
    for (int round = 0; round < 60; ++round) {
        const int sections = 1 + static_cast<int>(random() % (round % 4 == 0 ? 256 : 24));
        const int first = -128 + static_cast<int>(random() % static_cast<unsigned>(257 - sections));
        const world::Heights heights{first * 16, (first + sections) * 16};
        const auto count = static_cast<std::size_t>(heights.layers() * world::kBlocksPerLayer);
        std::vector<world::BlockId> blocks(count);
        std::vector<std::uint16_t> states(count);
        Chunk chunk(heights);
        for (int n = heights.firstSection(); n < heights.endSection(); ++n) {
            if (random() % 3 != 0) continue;
            const auto id = static_cast<world::BlockId>(random() % 3);
            chunk.setSection(n, Section(id));
            std::fill_n(blocks.begin() + (n - first) * world::kBlocksPerSection, world::kBlocksPerSection,
                        id);
        }
        const world::BlockIndex bottom = heights.bottom * world::kBlocksPerLayer;
        for (int step = 0; step < 3000; ++step) {
            const world::BlockIndex i = randomIndex(random, heights);
            const auto at = static_cast<std::size_t>(i - bottom);
            chunk.setBlock(i, blocks[at] = static_cast<world::BlockId>(random() % 2000));
            chunk.setBlockState(i, states[at] = static_cast<std::uint16_t>(random() % 4 == 0 ? random() : 0));
        }
        for (const world::BlockIndex i : {bottom, bottom + static_cast<int>(count) - 1})
            chunk.setBlockEntityData(i, randomBytes(random, 5));
        const auto back = decodeChunk(encode(chunk), allIds(), heights);
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(back->heights(), heights);
        for (std::size_t at = 0; at < count; ++at) {
            const world::BlockIndex i = bottom + static_cast<world::BlockIndex>(at);
            ASSERT_EQ(back->block(i), blocks[at]) << describe(heights) << " " << i;
            ASSERT_EQ(back->blockState(i), states[at]);
        }
        ASSERT_EQ(*back, chunk) << "also block entity data";
        ASSERT_EQ(encode(*back), encode(chunk));
    }
}

TEST(TallChunkCodec, AllRepresentationsComeBack) {
    std::mt19937 random(12);
    for (int round = 0; round < 20; ++round)
        for (const world::Heights heights : kTallHeights) {
            if (heights.layers() > 1000 && round > 2) continue;
            const Chunk chunk = randomChunk(random, heights);
            const auto back = decodeChunk(encode(chunk), allIds(), heights);
            ASSERT_TRUE(back) << back.error().message;
            ASSERT_EQ(*back, chunk);
        }
}

// The bytes of docs/file-format.md.
TEST(TallChunkCodec, ContentOfAUniformChunk) {
    constexpr world::Heights kHeights{-64, 320};
    Chunk chunk(kHeights);
    for (int n = -4; n < 2; ++n) chunk.setSection(n, Section(7));
    Bytes expected;
    for (const int number : {-64, 320}) appendNumber(expected, static_cast<std::int16_t>(number));
    for (const auto& [sections, id] :
         {std::pair{6, 7}, {18, 0}, {24, 0}}) {  // two runs of blocks, one of states
        appendNumber(expected, static_cast<std::uint8_t>(sections - 1));
        appendNumber(expected, std::uint8_t{0});
        appendNumber(expected, static_cast<std::uint16_t>(id));
    }
    appendNumber(expected, std::uint32_t{0});
    EXPECT_EQ(contentOf(encode(chunk)), expected);
    EXPECT_EQ(encode(chunk)[8], std::byte{kTallChunkVersion});
}

// A column of 4,096 layers takes nearly the bytes of its content.
TEST(TallChunkCodec, BytesFollowContent) {
    std::mt19937 random(13);
    constexpr world::Heights kTall{-2048, 2048};
    for (int round = 0; round < 10; ++round) {
        Chunk low, tall(kTall);
        for (int n = 0; n < 6; ++n) low.setSection(n, randomSection(random, 3 + n));
        for (int n = kTall.firstSection(); n < 0; ++n) tall.setSection(n, Section(1));
        for (int n = 0; n < 16; ++n) tall.setSection(n, low.section(n));
        EXPECT_NEAR(encode(tall).size(), encode(low).size(), 32);
    }
    EXPECT_LT(encode(Chunk(kTall)).size(), 40u);
}

TEST(TallChunkCodec, EveryTruncationIsRefused) {
    std::mt19937 random(14);
    constexpr world::Heights kHeights{-64, 64};
    Chunk chunk(kHeights);
    chunk.setSection(-4, Section(1));
    chunk.setSection(-3, Section(1));
    chunk.setSection(0, randomSection(random, 2));
    chunk.setBlockStateSection(2, randomSection(random, 5));
    chunk.setBlockEntityData(kHeights.bottom * 256, randomBytes(random, 3));
    const Bytes whole = encode(chunk), content = contentOf(whole);
    ASSERT_EQ(errorOf(tallFrame(content), kHeights), "");
    for (std::size_t length = 0; length < content.size(); ++length)
        ASSERT_NE(errorOf(tallFrame(ByteView(content).first(length)), kHeights), "") << length;
    for (std::size_t length = 8; length < whole.size(); ++length)
        ASSERT_NE(errorOf(withChecksum({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}),
                          kHeights),
                  "")
            << length;
    Bytes longer = content;
    longer.push_back({});
    EXPECT_THAT(errorOf(tallFrame(longer), kHeights), HasSubstr("1 bytes too many"));
}

TEST(TallChunkCodec, SaysWhatIsWrong) {
    constexpr world::Heights kHeights{-64, 320};
    const Bytes none(4);
    EXPECT_EQ(errorOf(tallFrame(plainTall(kHeights, {24, 24}, none)), kHeights), "");
    EXPECT_EQ(errorOf(tallFrame(plainTall(kHeights, {1, 23, 20, 4}, none)), kHeights), "");
    EXPECT_THAT(errorOf(tallFrame(plainTall({-64, 336}, {25, 25}, none)), kHeights),
                HasSubstr("the chunk has bottom -64 and top 336, its world -64 and 320"));
    EXPECT_THAT(errorOf(tallFrame(plainTall({0, 384}, {24, 24}, none)), kHeights), HasSubstr("bottom 0"));
    EXPECT_THAT(errorOf(tallFrame(plainTall(kHeights, {25, 24}, none)), kHeights),
                HasSubstr("more than 24 sections"));
    EXPECT_THAT(errorOf(tallFrame(plainTall(kHeights, {256, 24}, none)), kHeights),
                HasSubstr("more than 24 sections"));
    EXPECT_THAT(errorOf(tallFrame(plainTall(kHeights, {24, 23, 2}, none)), kHeights),
                HasSubstr("more than 24 sections"));
    EXPECT_NE(errorOf(tallFrame(plainTall(kHeights, {23, 24}, none)), kHeights), "") << "too few sections";
    EXPECT_THAT(errorOf(tallFrame(plainTall(kHeights, {}, Bytes(10, std::byte{1}))), kHeights),
                HasSubstr("palette of 257"));
    EXPECT_THAT(errorOf(tallFrame(plainTall(kHeights, {}, Bytes(10, std::byte{16}))), kHeights),
                HasSubstr("17 sections of 16 bits per block have one head"));
    EXPECT_THAT(errorOf(frame(plainAir(none)), kHeights), HasSubstr("chunk version 1, expected 2"));
    EXPECT_THAT(errorOf(tallFrame(plainTall(kHeights, {24, 24}, none))),
                HasSubstr("chunk version 2, expected 1"));
    Bytes many;
    appendNumber(many, std::uint32_t{98305});
    EXPECT_THAT(errorOf(tallFrame(plainTall(kHeights, {24, 24}, many)), kHeights), HasSubstr("98305 blocks"));
}

TEST(TallChunkCodec, HostileIndicesAreRefused) {
    constexpr world::Heights kHeights{-64, 320};
    const auto errorOfBlocks = [&](const std::vector<std::int32_t>& indices) {
        Bytes large;
        appendNumber(large, static_cast<std::uint32_t>(indices.size()));
        for (const std::int32_t index : indices) {
            appendNumber(large, index);
            appendNumber(large, std::uint32_t{0});
        }
        return errorOf(tallFrame(plainTall(kHeights, {24, 24}, large)), kHeights);
    };
    EXPECT_EQ(errorOfBlocks({-64 * 256, -1, 0, 320 * 256 - 1}), "");
    for (const std::int32_t index : {-64 * 256 - 1, 320 * 256, INT32_MIN, INT32_MAX})
        EXPECT_THAT(errorOfBlocks({index}), HasSubstr("is not in the chunk")) << index;
    EXPECT_THAT(errorOfBlocks({5, 5}), HasSubstr("out of order"));
    EXPECT_THAT(errorOfBlocks({5, -5}), HasSubstr("out of order"));
}

TEST(TallChunkCodec, DamagedContent) {
    std::mt19937 random(15);
    for (int round = 0; round < 20; ++round) {
        const world::Heights heights = kTallHeights[random() % std::size(kTallHeights)];
        if (heights.layers() > 1000 && round > 2) continue;
        const Bytes plain = contentOf(encode(randomChunk(random, heights)));
        for (int step = 0; step < 30; ++step) {
            Bytes bad = plain;
            const std::size_t near = random() % std::min<std::size_t>(bad.size(), 300);
            bad[random() % 2 ? near : bad.size() - 1 - near] = static_cast<std::byte>(random());
            (void)errorOf(tallFrame(bad), heights);
            bad.resize(random() % plain.size());
            EXPECT_NE(errorOf(tallFrame(bad), heights), "") << "cut off";
        }
    }
}

TEST(TallChunkCodec, EntityDataOfTheHighestWorlds) {
    constexpr world::Heights kTall{-2048, 2048};
    Chunk chunk(kTall);
    chunk.setBlockEntityData(-2048 * 256, world::BlockEntityData(30u << 20));
    EXPECT_TRUE(encodeChunk(chunk, allIds()));
    chunk.setBlockEntityData(2048 * 256 - 1, world::BlockEntityData(3u << 20));
    const auto bytes = encodeChunk(chunk, allIds());
    ASSERT_FALSE(bytes);
    EXPECT_THAT(bytes.error().message, HasSubstr("block entity data"));
}

TEST(ChunkCodec, SealsNothingShorterThanAHeader) {
    std::vector<std::byte> bytes(7);
    EXPECT_THROW(sealChunk(bytes, 1), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::store
