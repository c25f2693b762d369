#include "terrane/store/chunks/chunk_codec.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
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

// Index of a block in version 1; other versions have the whole world::BlockIndex.
using LowIndex = std::uint16_t;

std::size_t entryBytes(std::uint8_t version) {
    return (version == kLowChunkVersion ? sizeof(LowIndex) : sizeof(world::BlockIndex)) +
           sizeof(std::uint32_t);
}

// Before compression, for everything but block entity data: a layer takes up to 1 KiB of blocks and block
// states, and up to 2 KiB of indices and lengths of block entity data.
std::size_t roomBesideEntityData(world::Heights heights) {
    constexpr std::size_t kBytesALayer = 8192;
    return kBytesALayer * static_cast<std::size_t>(heights.layers());
}

// Before compression, for the sections of blocks and block states: a layer takes up to 1 KiB, and a little
// for heads.
std::size_t maxSectionBytes(world::Heights heights) {
    constexpr std::size_t kBytesALayer = 2048;
    return kBytesALayer * static_cast<std::size_t>(heights.layers());
}

base::Result<void> appendBlockEntityData(Bytes& out, const world::Chunk& chunk) {
    const std::vector<world::BlockIndex> large = chunk.blocksWithBlockEntityData();
    std::size_t totalBytes = 0;
    for (const world::BlockIndex i : large) totalBytes += chunk.blockEntityData(i)->size();
    const std::size_t maxBytes = kMaxChunkBytes - roomBesideEntityData(chunk.heights());
    if (totalBytes > maxBytes)
        return base::fail("the chunk has {} bytes of block entity data, a save keeps at most {}", totalBytes,
                          maxBytes);
    const bool isLow = chunkVersion(chunk.heights()) == kLowChunkVersion;
    appendNumber(out, static_cast<std::uint32_t>(large.size()));
    for (const world::BlockIndex i : large) {
        if (isLow)
            appendNumber(out, static_cast<LowIndex>(i));
        else
            appendNumber(out, i);
        appendNumber(out, static_cast<std::uint32_t>(chunk.blockEntityData(i)->size()));
    }
    for (const world::BlockIndex i : large) append(out, *chunk.blockEntityData(i));
    return {};
}

// Sections one above the other that are the same and uniform, or a single section.
struct Run {
    Section section;  // compact
    int count = 0;
};

// The sections that `sectionOf` returns for their numbers, from below. In version 1 each is a run.
template <class SectionOf>
std::vector<Run> runsOf(world::Heights heights, SectionOf sectionOf) {
    const bool hasRuns = chunkVersion(heights) != kLowChunkVersion;
    std::vector<Run> runs;
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        Section section = sectionOf(number);
        section.compact();
        if (hasRuns && !runs.empty() && section.isUniform() && section.isSame(runs.back().section))
            ++runs.back().count;
        else
            runs.push_back({std::move(section), 1});
    }
    return runs;
}

base::Result<void> appendPlain(Bytes& out, const world::Chunk& chunk, const BlockIdMap& ids) {
    const world::Heights heights = chunk.heights();
    const std::vector<Run> blocks = runsOf(heights, [&](int number) { return chunk.section(number); });
    const std::vector<Run> states = runsOf(heights, [&](int number) { return chunk.blockStates(number); });
    SectionWriter blockWriter(out, [&](Value id) { return ids.toSaved(id); });
    SectionWriter stateWriter(out, kSameValue);
    const bool isLow = chunkVersion(heights) == kLowChunkVersion;
    const auto appendHeads = [&](const std::vector<Run>& runs, auto& writer) {
        for (const Run& run : runs) {
            if (!isLow) appendNumber(out, static_cast<std::uint8_t>(run.count - 1));
            writer.head(run.section);
        }
    };
    if (!isLow) {
        appendNumber(out, static_cast<std::int16_t>(heights.bottom));
        appendNumber(out, static_cast<std::int16_t>(heights.top));
    }
    // Heads first, then the words: 2 % smaller than section by section.
    appendHeads(blocks, blockWriter);
    appendHeads(states, stateWriter);
    for (const Run& run : blocks) blockWriter.words(run.section);
    for (const Run& run : states) stateWriter.words(run.section);
    if (blockWriter.unmapped())
        return base::fail("block id {} stands for no block type", *blockWriter.unmapped());
    return appendBlockEntityData(out, chunk);
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

base::Result<Section> readSection(ByteReader& reader, const SectionHead& head) {
    if (head.bits == 0) return Section(head.uniformValue);
    std::array<std::uint64_t, world::kBlocksPerSection * 16 / 64> room{};
    const auto words =
        std::span(room).first(static_cast<std::size_t>(world::kBlocksPerSection * head.bits / 64));
    reader.copyTo(std::as_writable_bytes(words));
    auto section = Section::fromPacked(head.bits, head.palette, words);
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
    auto section = readSection(reader, head);
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
    const world::Heights heights = chunk.heights();
    const std::uint8_t version = chunkVersion(heights);
    const auto count = reader.number<std::uint32_t>();
    if (count > static_cast<std::uint32_t>(heights.layers() * world::kBlocksPerLayer))
        return base::fail(base::ErrorCode::Damaged, "{} blocks have block entity data", count);
    ByteReader entries(reader.take(count * entryBytes(version)));
    std::int64_t last = std::numeric_limits<std::int64_t>::min();
    for (std::uint32_t n = 0; n < count && !reader.isPastEnd(); ++n) {
        const world::BlockIndex index =
            version == kLowChunkVersion ? entries.number<LowIndex>() : entries.number<world::BlockIndex>();
        if (index <= last)
            return base::fail(base::ErrorCode::Damaged, "block entity data of blocks is out of order");
        if (!heights.contains(index >> 8))
            return base::fail(base::ErrorCode::Damaged, "block {} with block entity data is not in the chunk",
                              index);
        last = index;
        auto data = TERRANE_TRY(holdData(reader.take(entries.number<std::uint32_t>()), budget));
        chunk.shareBlockEntityData(index, std::move(data));
    }
    return {};
}

struct HeadRun {
    SectionHead head;
    int count = 0;
};

// Reads the heads of a chunk's sections, of blocks or of block states, from below.
base::Result<std::vector<HeadRun>> readHeads(ByteReader& reader, world::Heights heights) {
    const bool hasRuns = chunkVersion(heights) != kLowChunkVersion;
    std::vector<HeadRun> runs;
    for (int sections = 0; sections < heights.sections() && !reader.isPastEnd();) {
        HeadRun run;
        run.count = hasRuns ? reader.number<std::uint8_t>() + 1 : 1;
        run.head = TERRANE_TRY(readHead(reader));
        sections += run.count;
        if (sections > heights.sections())
            return base::fail(base::ErrorCode::Damaged, "the chunk has more than {} sections",
                              heights.sections());
        if (run.count > 1 && run.head.bits != 0)
            return base::fail(base::ErrorCode::Damaged, "{} sections of {} bits per block have one head",
                              run.count, run.head.bits);
        runs.push_back(std::move(run));
    }
    return runs;
}

base::Result<void> checkSaved(ByteReader& reader, world::Heights heights) {
    if (chunkVersion(heights) == kLowChunkVersion) return {};
    const int bottom = reader.number<std::int16_t>(), top = reader.number<std::int16_t>();
    if (heights == world::Heights{bottom, top}) return {};
    return base::fail(base::ErrorCode::Damaged, "the chunk has bottom {} and top {}, its world {} and {}",
                      bottom, top, heights.bottom, heights.top);
}

base::Result<world::Chunk> readPlain(ByteView bytes, const BlockIdMap& ids, world::Heights heights,
                                     EntityBudget* budget) {
    ByteReader reader(bytes);
    TERRANE_TRY(checkSaved(reader, heights));
    auto blocks = TERRANE_TRY(readHeads(reader, heights));
    auto states = TERRANE_TRY(readHeads(reader, heights));
    world::Chunk chunk(heights);
    int number = heights.firstSection();
    for (HeadRun& run : blocks) {
        if (reader.isPastEnd()) break;
        const auto section = TERRANE_TRY(readBlocks(reader, std::move(run.head), ids));
        for (int k = 0; k < run.count; ++k) chunk.setSection(number++, section);
    }
    number = heights.firstSection();
    for (const HeadRun& run : states) {
        if (reader.isPastEnd()) break;
        const auto section = TERRANE_TRY(readSection(reader, run.head));
        for (int k = 0; k < run.count; ++k) chunk.setBlockStateSection(number++, section);
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
    appendNumber(out, chunkVersion(chunk.heights()));
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

base::Result<void> verifyChunk(ByteView bytes, world::Heights heights, std::uint64_t seed) {
    if (bytes.size() < kHeaderBytes)
        return base::fail(base::ErrorCode::Damaged, "{} bytes are too few for a chunk", bytes.size());
    ByteReader reader(bytes);
    const auto sum = reader.number<std::uint64_t>();
    if (sum != checksum(bytes, seed)) return base::fail(base::ErrorCode::Damaged, "the checksum is wrong");
    const auto version = reader.number<std::uint8_t>();
    if (version != chunkVersion(heights))
        return base::fail(base::ErrorCode::Damaged, "chunk version {}, expected {}", version,
                          chunkVersion(heights));
    return {};
}

base::Result<world::Chunk> decodeChunk(ByteView bytes, const BlockIdMap& ids, world::Heights heights,
                                       std::uint64_t seed, EntityBudget* budget) {
    TERRANE_TRY(verifyChunk(bytes, heights, seed));
    ByteReader reader(bytes.subspan(sizeof(std::uint64_t) + sizeof(std::uint8_t)));
    const auto plainBytes = reader.number<std::uint32_t>();
    if (plainBytes > kMaxChunkBytes)
        return base::fail(base::ErrorCode::Damaged, "the chunk says it has {} bytes, expected at most {}",
                          plainBytes, kMaxChunkBytes);
    std::unique_lock<std::mutex> alone;
    if (budget && plainBytes > kMaxScratchBytes) {
        alone = budget->lockLargeChunks();
        // Everything except the sections will be held: check the budget before decompressing.
        const std::size_t sections = std::max(kMaxScratchBytes, maxSectionBytes(heights));
        if (plainBytes > sections && !budget->hasRoomFor(plainBytes - sections)) return overBudget(*budget);
    }
    Scratch scratch;
    Bytes& plain = scratch.bytes();
    plain.resize(plainBytes);
    TERRANE_TRY(decompress(reader.rest(), plain));
    return readPlain(plain, ids, heights, budget);
}

}  // namespace terrane::store
