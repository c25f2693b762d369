#include "terrane/store/chunks/chunk_codec.h"

#include <xxhash.h>

#include <array>
#include <cassert>
#include <optional>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/store/chunks/bytes.h"

namespace terrane::store {
namespace {

using world::Section;
using Value = Section::Value;

// Checksum of everything after it, version, uncompressed size; then a zstd frame.
constexpr std::size_t kHeaderBytes = sizeof(std::uint64_t) + sizeof(std::uint8_t) + sizeof(std::uint32_t);

// Checksum of an encoded chunk, over everything after the checksum itself.
std::uint64_t checksum(ByteView bytes, std::uint64_t seed) {
    const ByteView rest = bytes.subspan(sizeof(std::uint64_t));
    return XXH64(rest.data(), rest.size(), seed);
}

constexpr std::size_t wordCount(int bits) {
    return static_cast<std::size_t>(world::kBlocksPerSection * bits / 64);
}

// Writes sections. `Map` maps a value to its saved value, or to BlockIdMap::kNone.
template <class Map>
class SectionWriter {
  public:
    SectionWriter(Bytes& out, Map map) : out_(out), map_(map) {}

    // `section` is compact, so that equal sections have equal heads and words.
    void head(const Section& section) {
        appendNumber(out_, static_cast<std::uint8_t>(section.bits()));
        if (section.isUniform()) return value(section.uniformValue());
        if (section.isDense()) return;
        appendNumber(out_, static_cast<std::uint16_t>(section.palette().size()));
        for (const Value v : section.palette()) value(v);
    }

    void words(const Section& section) {
        if (!section.isDense()) return append(out_, std::as_bytes(section.words()));
        std::array<Value, world::kBlocksPerSection> values;
        section.unpack(values);
        for (const Value v : values) value(v);
    }

    std::optional<Value> unmapped() const { return unmapped_; }  // a value without a saved value

  private:
    void value(Value v) {
        const std::uint32_t mapped = map_(v);
        if (mapped == BlockIdMap::kNone) unmapped_ = v;
        appendNumber(out_, static_cast<Value>(mapped));
    }

    Bytes& out_;
    Map map_;
    std::optional<Value> unmapped_;
};

constexpr auto kSameValue = [](Value v) { return std::uint32_t{v}; };

base::Result<void> appendBlockEntityData(Bytes& out, const world::Chunk& chunk,
                                         std::span<const world::BlockIndex> large) {
    std::size_t totalBytes = 0;
    for (const world::BlockIndex i : large) totalBytes += chunk.blockEntityData(i)->size();
    constexpr std::size_t kMaxBytes = kMaxChunkBytes - (2u << 20);  // the rest is for sections and lengths
    if (totalBytes > kMaxBytes)
        return base::fail("the chunk has {} bytes of block entity data, a save keeps at most {}", totalBytes,
                          kMaxBytes);
    appendNumber(out, static_cast<std::uint32_t>(large.size()));
    for (const world::BlockIndex i : large) {
        appendNumber(out, i);
        appendNumber(out, static_cast<std::uint32_t>(chunk.blockEntityData(i)->size()));
    }
    for (const world::BlockIndex i : large) append(out, *chunk.blockEntityData(i));
    return {};
}

base::Result<void> appendPlain(Bytes& out, const world::Chunk& chunk, const BlockIdMap& ids) {
    const std::vector<world::BlockIndex> large = chunk.blocksWithBlockEntityData();
    std::array<Section, world::kSectionsPerChunk> blocks, blockState;
    for (int n = 0; n < world::kSectionsPerChunk; ++n) {
        const auto k = static_cast<std::size_t>(n);
        blocks[k] = chunk.section(n);
        blocks[k].compact();
        blockState[k] = chunk.blockStates(n);
        blockState[k].compact();
    }
    SectionWriter blockWriter(out, [&](Value id) { return ids.toSaved(id); });
    SectionWriter dataWriter(out, kSameValue);
    // Heads first, then the words: 2 % smaller than section by section.
    for (const Section& section : blocks) blockWriter.head(section);
    for (const Section& section : blockState) dataWriter.head(section);
    for (const Section& section : blocks) blockWriter.words(section);
    for (const Section& section : blockState) dataWriter.words(section);
    if (blockWriter.unmapped())
        return base::fail("block id {} stands for no block type", *blockWriter.unmapped());
    return appendBlockEntityData(out, chunk, large);
}

struct SectionHead {
    int bits = 0;
    Value uniformValue = 0;
    std::vector<Value> palette;
};

base::Result<SectionHead> readHead(ByteReader& reader) {
    SectionHead head;
    head.bits = reader.number<std::uint8_t>();
    switch (head.bits) {
        case 0:
            head.uniformValue = reader.number<Value>();
            return head;
        case 1:
        case 2:
        case 4:
        case 8: {
            const auto count = reader.number<std::uint16_t>();
            if (count > 256)
                return base::fail(base::ErrorCode::Damaged, "a section has a palette of {} values", count);
            head.palette.resize(count);
            reader.copyTo(std::as_writable_bytes(std::span(head.palette)));
            return head;
        }
        case 16:
            return head;
        default:
            return base::fail(base::ErrorCode::Damaged, "a section has {} bits per block", head.bits);
    }
}

base::Result<Section> readSection(ByteReader& reader, SectionHead head) {
    if (head.bits == 0) return Section(head.uniformValue);
    std::vector<std::uint64_t> words(wordCount(head.bits));
    reader.copyTo(std::as_writable_bytes(std::span(words)));
    auto section = Section::fromPacked(head.bits, std::move(head.palette), std::move(words));
    if (!section)
        return base::fail(base::ErrorCode::Damaged, "a section's palette of {} bits does not fit its blocks",
                          head.bits);
    return std::move(*section);
}

// Reads a section and maps saved ids to session ids.
base::Result<Section> readBlocks(ByteReader& reader, SectionHead head, const BlockIdMap& ids) {
    std::optional<Value> unnamed;
    const auto map = [&](Value& id) {
        const std::uint32_t session = ids.toSession(id);
        if (session == BlockIdMap::kNone) unnamed = id;
        id = static_cast<Value>(session);
    };
    if (head.bits == 0) map(head.uniformValue);
    for (Value& id : head.palette) map(id);
    const bool isDense = head.bits == 16;
    auto section = readSection(reader, std::move(head));
    if (section && isDense) {
        std::array<Value, world::kBlocksPerSection> values;
        section->unpack(values);
        for (Value& id : values) map(id);
        section = Section::fromValues(values);
    }
    if (section && unnamed)
        return base::fail(base::ErrorCode::Damaged, "block id {} has no name in this save", *unnamed);
    return section;
}

base::Result<void> readBlockEntityData(ByteReader& reader, world::Chunk& chunk, EntityBudget* budget) {
    const auto count = reader.number<std::uint32_t>();
    if (count > world::kBlocksPerChunk)
        return base::fail(base::ErrorCode::Damaged, "{} blocks have block entity data", count);
    constexpr std::size_t kEntryBytes = sizeof(world::BlockIndex) + sizeof(std::uint32_t);
    ByteReader entries(reader.take(count * kEntryBytes));
    int last = -1;
    for (std::uint32_t n = 0; n < count && !reader.isPastEnd(); ++n) {
        const auto index = entries.number<world::BlockIndex>();
        if (index <= last)
            return base::fail(base::ErrorCode::Damaged, "block entity data of blocks is out of order");
        last = index;
        auto data = TERRANE_TRY(holdData(reader.take(entries.number<std::uint32_t>()), budget));
        chunk.shareBlockEntityData(index, std::move(data));
    }
    return {};
}

base::Result<world::Chunk> readPlain(ByteView bytes, const BlockIdMap& ids, EntityBudget* budget) {
    ByteReader reader(bytes);
    std::array<SectionHead, 2 * world::kSectionsPerChunk> heads;
    for (SectionHead& head : heads) {
        auto read = TERRANE_TRY(readHead(reader));
        head = std::move(read);
    }
    world::Chunk chunk;
    for (int n = 0; n < 2 * world::kSectionsPerChunk && !reader.isPastEnd(); ++n) {
        SectionHead& head = heads[static_cast<std::size_t>(n)];
        const bool isBlocks = n < world::kSectionsPerChunk;
        auto section = TERRANE_TRY(isBlocks ? readBlocks(reader, std::move(head), ids)
                                            : readSection(reader, std::move(head)));
        if (isBlocks) {
            chunk.setSection(n, std::move(section));
        } else {
            chunk.setBlockStateSection(n - world::kSectionsPerChunk, std::move(section));
        }
    }
    TERRANE_TRY(readBlockEntityData(reader, chunk, budget));
    if (reader.isPastEnd()) return base::fail(base::ErrorCode::Damaged, "the chunk ends too early");
    if (!reader.rest().empty())
        return base::fail(base::ErrorCode::Damaged, "{} bytes too many", reader.rest().size());
    return chunk;
}

}  // namespace

base::Result<Bytes> encodeChunk(const world::Chunk& chunk, const BlockIdMap& ids, std::uint64_t seed) {
    Scratch scratch;
    Bytes& plain = scratch.bytes();
    TERRANE_TRY(appendPlain(plain, chunk, ids));
    assert(plain.size() <= kMaxChunkBytes && "block entity data is limited");

    Bytes out;
    out.reserve(plain.size() + kHeaderBytes);
    appendNumber(out, std::uint64_t{0});
    appendNumber(out, kChunkVersion);
    appendNumber(out, static_cast<std::uint32_t>(plain.size()));
    appendCompressed(out, plain);
    sealChunk(out, seed);
    out.shrink_to_fit();
    return out;
}

void sealChunk(std::span<std::byte> bytes, std::uint64_t seed) {
    base::require(bytes.size() >= kHeaderBytes, "sealChunk: less than the header of an encoded chunk");
    const std::uint64_t sum = checksum(bytes, seed);
    std::memcpy(bytes.data(), &sum, sizeof sum);
}

base::Result<void> verifyChunk(ByteView bytes, std::uint64_t seed) {
    if (bytes.size() < kHeaderBytes)
        return base::fail(base::ErrorCode::Damaged, "{} bytes are too few for a chunk", bytes.size());
    ByteReader reader(bytes);
    const auto sum = reader.number<std::uint64_t>();
    if (sum != checksum(bytes, seed)) return base::fail(base::ErrorCode::Damaged, "the checksum is wrong");
    const auto version = reader.number<std::uint8_t>();
    if (version != kChunkVersion)
        return base::fail(base::ErrorCode::Damaged, "chunk version {}, expected {}", version, kChunkVersion);
    return {};
}

base::Result<world::Chunk> decodeChunk(ByteView bytes, const BlockIdMap& ids, std::uint64_t seed,
                                       EntityBudget* budget) {
    TERRANE_TRY(verifyChunk(bytes, seed));
    ByteReader reader(bytes.subspan(sizeof(std::uint64_t) + sizeof(std::uint8_t)));
    const auto plainBytes = reader.number<std::uint32_t>();
    if (plainBytes > kMaxChunkBytes)
        return base::fail(base::ErrorCode::Damaged, "the chunk says it has {} bytes, expected at most {}",
                          plainBytes, kMaxChunkBytes);
    std::unique_lock<std::mutex> alone;
    if (budget && plainBytes > kMaxScratchBytes) {
        alone = budget->lockLargeChunks();
        // Everything except the sections will be held: check the budget before decompressing.
        if (!budget->hasRoomFor(plainBytes - kMaxScratchBytes)) return overBudget(*budget);
    }
    Scratch scratch;
    Bytes& plain = scratch.bytes();
    plain.resize(plainBytes);
    TERRANE_TRY(decompress(reader.rest(), plain));
    return readPlain(plain, ids, budget);
}

}  // namespace terrane::store
