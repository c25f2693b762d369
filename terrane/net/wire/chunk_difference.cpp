#include "terrane/net/wire/chunk_difference.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <utility>

namespace terrane::net {
namespace {

using world::kBlocksPerSection;

// The part of a block's value that is encoded once per run; block entity data is encoded apart.
using BlockKind = std::pair<world::BlockId, std::uint16_t>;  // id, block state

BlockKind kindOf(const world::BlockValue& value) {
    return {value.id, value.state};
}

world::BlockValue valueAt(const world::Chunk& chunk, world::BlockIndex i) {
    return {chunk.block(i), chunk.blockState(i), chunk.sharedBlockEntityData(i)};
}

bool isEqualSection(const world::Chunk& a, const world::Chunk& b, int number) {
    return a.section(number) == b.section(number) && a.blockStates(number) == b.blockStates(number);
}

// Adds the sections that contain block entity data.
void addSectionsWithData(world::SectionSet& sections, const world::Chunk& chunk) {
    for (const world::BlockIndex i : chunk.blocksWithBlockEntityData()) sections.add(world::sectionOf(i));
}

// The indices of a range, from `begin` on.
struct Indices {
    world::BlockIndex begin = 0, end = 0;
};
constexpr Indices indicesOf(world::Heights heights) {
    return {heights.bottom * world::kBlocksPerLayer, heights.top * world::kBlocksPerLayer};
}
constexpr Indices indicesOf(IndexRange range) {
    constexpr world::Heights kAll{world::kLowestBottom, world::kHighestTop};
    return indicesOf(range == IndexRange::Low ? world::Heights() : kAll);
}

// Number of contiguous blocks from `begin` on that have the same kind.
std::size_t runLength(std::span<const ChangedBlock> blocks, std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < blocks.size() && blocks[end].index == blocks[end - 1].index + 1 &&
           kindOf(blocks[end].value) == kindOf(blocks[begin].value))
        ++end;
    return end - begin;
}

std::size_t dataBytes(const ChangedBlock& block) {
    return block.value.data ? block.value.data->size() : 0;
}

bool travels(const ChangedBlock& block) {
    return block.value.data && block.value.data->size() <= kMaxBlockData;
}

struct BlockKinds {
    std::vector<BlockKind> list;  // in order of first occurrence
    std::map<BlockKind, std::uint32_t> numbers;
};

BlockKinds kindsOf(std::span<const ChangedBlock> blocks) {
    BlockKinds kinds;
    for (const ChangedBlock& block : blocks) {
        const BlockKind kind = kindOf(block.value);
        if (kinds.numbers.try_emplace(kind, static_cast<std::uint32_t>(kinds.list.size())).second)
            kinds.list.push_back(kind);
    }
    return kinds;
}

void writeData(WireWriter& wire, std::span<const ChangedBlock> blocks, IndexRange range) {
    wire.number(static_cast<std::uint64_t>(std::ranges::count_if(blocks, travels)));
    for (const ChangedBlock& block : blocks) {
        if (!travels(block)) continue;
        if (range == IndexRange::Low)
            wire.fixed(static_cast<std::uint16_t>(block.index));
        else
            wire.number(static_cast<std::uint32_t>(block.index - indicesOf(range).begin));
        wire.data(*block.value.data, kMaxBlockData);
    }
}

void readKinds(WireReader& wire, std::vector<BlockKind>& kinds) {
    wire.list(kinds, kMaxBlocksInPart, [&](BlockKind& kind) {
        wire.number(kind.first);
        wire.number(kind.second);
    });
    std::vector<BlockKind> sorted = kinds;
    std::ranges::sort(sorted);
    wire.require(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
}

// `next`: the end of the run before, counted from the range's first index.
void readRun(WireReader& wire, std::span<const BlockKind> kinds, Indices indices, std::uint32_t& next,
             ChunkDifference& blocks) {
    std::uint32_t head = 0, more = 0, kind = 0;
    wire.number(head);
    const bool isLong = head & 1;
    if (isLong) wire.number(more);
    if (kinds.size() > 1) wire.number(kind);
    const std::uint64_t begin = std::uint64_t{next} + (head >> 1);
    const std::uint64_t length = isLong ? std::uint64_t{more} + 2 : 1;
    const auto count = static_cast<std::uint64_t>(indices.end - indices.begin);
    wire.require(begin + length <= count && blocks.size() + length <= kMaxBlocksInPart);
    wire.require(kind < kinds.size());
    if (wire.hasFailed()) return;
    for (std::uint64_t k = 0; k < length; ++k)
        blocks.push_back({indices.begin + static_cast<world::BlockIndex>(begin + k),
                          {kinds[kind].first, kinds[kind].second, {}}});
    next = static_cast<std::uint32_t>(begin + length);
}

world::BlockIndex readIndex(WireReader& wire, IndexRange range) {
    if (range == IndexRange::Low) {
        std::uint16_t index = 0;
        wire.fixed(index);
        return index;
    }
    const Indices indices = indicesOf(range);
    std::uint32_t fromBegin = 0;
    wire.number(fromBegin);
    wire.require(fromBegin < static_cast<std::uint32_t>(indices.end - indices.begin));
    return wire.hasFailed() ? 0 : indices.begin + static_cast<world::BlockIndex>(fromBegin);
}

void readData(WireReader& wire, ChunkDifference& blocks, IndexRange range) {
    std::uint64_t count = 0, bytes = 0;
    wire.number(count);
    wire.require(count <= blocks.size());
    auto block = blocks.begin();
    for (std::uint64_t k = 0; k < count && !wire.hasFailed(); ++k) {
        const world::BlockIndex index = readIndex(wire, range);
        block = std::ranges::lower_bound(block, blocks.end(), index, {}, &ChangedBlock::index);
        wire.require(block != blocks.end() && block->index == index);
        Bytes data;
        wire.data(data, kMaxBlockData);
        wire.require((bytes += data.size()) <= kMaxDataInPart);
        if (wire.hasFailed()) return;
        (block++)->value.data = std::make_shared<const world::BlockEntityData>(std::move(data));
    }
}

}  // namespace

ChunkDifference chunkDifference(const world::Chunk& generated, const world::Chunk& edited) {
    assert(generated.heights() == edited.heights() && "chunks of one world");
    const world::Heights heights = edited.heights();
    ChunkDifference difference;
    world::SectionSet withData;
    addSectionsWithData(withData, generated);
    addSectionsWithData(withData, edited);
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        if (!withData.has(number) && isEqualSection(generated, edited, number)) continue;
        for (int k = 0; k < kBlocksPerSection; ++k) {
            const world::BlockIndex i = number * kBlocksPerSection + k;
            world::BlockValue value = valueAt(edited, i);
            if (value != valueAt(generated, i)) difference.push_back({i, std::move(value)});
        }
    }
    return difference;
}

bool isWithin(std::span<const ChangedBlock> blocks, world::Heights heights) {
    const Indices indices = indicesOf(heights);
    return blocks.empty() ||
           (blocks.front().index >= indices.begin && blocks.back().index < indices.end);  // they are sorted
}

void applyDifference(world::Chunk& chunk, std::span<const ChangedBlock> difference) {
    assert(isWithin(difference, chunk.heights()) && "the blocks are in the chunk");
    for (const auto& [index, value] : difference) {
        chunk.setBlock(index, value.id);
        chunk.setBlockState(index, value.state);
        if (value.data)
            chunk.shareBlockEntityData(index, value.data);
        else
            chunk.clearBlockEntityData(index);
    }
}

std::vector<world::PlacedBlock> placedBlocks(world::ChunkPos pos, std::span<const ChangedBlock> blocks) {
    std::vector<world::PlacedBlock> placed;
    placed.reserve(blocks.size());
    for (const ChangedBlock& block : blocks)
        placed.push_back({world::blockPos(pos, block.index), block.value});
    return placed;
}

void mergeInto(ChunkDifference& to, std::span<const ChangedBlock> newer) {
    ChunkDifference merged;
    merged.reserve(to.size() + newer.size());
    // set_union takes equal elements from the first range.
    std::ranges::set_union(newer, to, std::back_inserter(merged), {}, &ChangedBlock::index,
                           &ChangedBlock::index);
    to = std::move(merged);
}

std::vector<std::span<const ChangedBlock>> partsOf(std::span<const ChangedBlock> difference) {
    static_assert(kMaxBlockData <= kMaxDataInPart, "each block's data fits a part");
    std::vector<std::span<const ChangedBlock>> parts;
    std::size_t begin = 0, bytes = 0;
    for (std::size_t k = 0; k < difference.size(); ++k) {
        const std::size_t more = travels(difference[k]) ? dataBytes(difference[k]) : 0;
        if (k - begin == kMaxBlocksInPart || bytes + more > kMaxDataInPart) {
            parts.push_back(difference.subspan(begin, k - begin));
            begin = k;
            bytes = 0;
        }
        bytes += more;
    }
    parts.push_back(difference.subspan(begin));
    return parts;
}

void writeBlocks(WireWriter& wire, std::span<const ChangedBlock> blocks, IndexRange range) {
    assert(blocks.size() <= kMaxBlocksInPart && "a part of a difference");
    const world::BlockIndex first = indicesOf(range).begin;
    const BlockKinds kinds = kindsOf(blocks);
    wire.list(kinds.list, kMaxBlocksInPart, [&](const BlockKind& kind) {
        wire.number(kind.first);
        wire.number(kind.second);
    });
    std::uint64_t runs = 0;
    for (std::size_t k = 0; k < blocks.size(); k += runLength(blocks, k)) ++runs;
    wire.number(runs);
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < blocks.size();) {
        const std::size_t length = runLength(blocks, k);
        const auto begin = static_cast<std::uint32_t>(blocks[k].index - first);
        wire.number((begin - next) << 1 | (length > 1));
        if (length > 1) wire.number(length - 2);
        if (kinds.list.size() > 1) wire.number(kinds.numbers.at(kindOf(blocks[k].value)));
        next = begin + static_cast<std::uint32_t>(length);
        k += length;
    }
    writeData(wire, blocks, range);
}

void readBlocks(WireReader& wire, ChunkDifference& blocks, IndexRange range) {
    blocks.clear();
    std::vector<BlockKind> kinds;
    readKinds(wire, kinds);
    std::uint64_t runs = 0;
    wire.number(runs);
    std::uint32_t next = 0;
    for (std::uint64_t k = 0; k < runs && !wire.hasFailed(); ++k)
        readRun(wire, kinds, indicesOf(range), next, blocks);
    readData(wire, blocks, range);
}

}  // namespace terrane::net
