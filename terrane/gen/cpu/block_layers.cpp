#include "terrane/gen/cpu/block_layers.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "terrane/world/chunk.h"

namespace terrane::gen {

namespace {

constexpr std::uint16_t kAllLayers = 0xFFFF;
static_assert(world::kSectionSize == 16, "a bit a layer");

constexpr std::size_t kLayerBytes = kTileLanes * sizeof(std::uint16_t);

// More kinds of constant layers than chunks have: 16 KiB.
constexpr std::size_t kMaxConstants = 32;

std::uint16_t bitsOfLayers(int first, int count) {
    return static_cast<std::uint16_t>(((1u << count) - 1) << first);
}

}  // namespace

BlockLayers::BlockLayers(world::Heights heights)
    : heights_(heights), parts_(static_cast<std::size_t>(heights.sections())) {
    clear();
}

std::optional<BlockLayers::LayersRange> BlockLayers::range(int first, int last) const {
    constexpr int kMaxSteps = 5 * world::kSectionSize;
    LayersRange all{range(first), true};
    int steps = 0;
    for (int z = first; z <= last; ++steps) {
        if (steps == kMaxSteps) return std::nullopt;
        const BlockRange layer = range(z);
        all.isAlike = all.isAlike && layer == all.blocks;
        all.blocks = {std::min(all.blocks.low, layer.low), std::max(all.blocks.high, layer.high)};
        z = partOf(z).step == 0 ? (z | (world::kSectionSize - 1)) + 1 : z + 1;
    }
    return all;
}

std::optional<std::uint16_t> BlockLayers::uniformBlock(int section) const {
    const Part& part = partOf(section * world::kSectionSize);
    if (part.step == 0) return *part.blocks;
    const std::uint16_t block = part.own->ranges[0].low;
    const auto isOne = [block](const BlockRange& r) { return r == BlockRange{block, block}; };
    if (!std::all_of(part.own->ranges.begin(), part.own->ranges.end(), isOne)) return std::nullopt;
    return block;
}

std::span<const std::uint16_t, world::kBlocksPerSection> BlockLayers::section(int number) const {
    const Part& part = partOf(number * world::kSectionSize);
    assert(part.own && "not one block");
    return part.own->blocks;
}

void BlockLayers::clear() {
    if (constants_.size() > kMaxConstants) constants_.clear();
    const std::uint16_t* air = constantLayer(world::kAir);
    for (Part& part : parts_) {
        if (part.own) spare_.push_back(std::move(part.own));
        part.blocks = air;
        part.step = part.written = 0;
    }
}

// Few: they are looked through one by one.
const std::uint16_t* BlockLayers::constantLayer(std::uint16_t block) {
    for (const auto& layer : constants_)
        if (layer->front() == block) return layer->data();
    constants_.push_back(std::make_unique<Layer>());
    constants_.back()->fill(block);
    return constants_.back()->data();
}

void BlockLayers::fill(int z, int count, std::uint16_t block) {
    assert(z >= heights_.bottom && z + count <= heights_.top && "layers of the world");
    const std::uint16_t* layer = constantLayer(block);
    for (const int end = z + count; z < end;) {
        const int first = z & (world::kSectionSize - 1);
        const int here = std::min(world::kSectionSize - first, end - z);
        fillPart(partOf(z), first, here, layer);
        z += here;
    }
}

void BlockLayers::fillPart(Part& part, int first, int count, const std::uint16_t* layer) {
    const std::uint16_t written = bitsOfLayers(first, count);
    const bool isLike = part.blocks == layer || (part.written & ~written) == 0;
    if (part.step == 0 && isLike) {
        part.blocks = layer;
        part.written = static_cast<std::uint16_t>(part.written | written);
        return;
    }
    Owned& owned = own(part);
    std::uint16_t* out = owned.blocks.data() + first * kTileLanes;
    for (int k = 0; k < count; ++k) std::memcpy(out + k * kTileLanes, layer, kLayerBytes);
    std::fill_n(owned.ranges.begin() + first, count, BlockRange{*layer, *layer});
}

BlockLayers::Owned& BlockLayers::own(Part& part) {
    if (part.own) return *part.own;
    if (spare_.empty()) {
        part.own = std::make_unique_for_overwrite<Owned>();
    } else {
        part.own = std::move(spare_.back());
        spare_.pop_back();
    }
    Owned& owned = *part.own;
    for (int k = 0; k < world::kSectionSize; ++k) {
        if ((part.written >> k & 1) == 0) continue;
        std::memcpy(owned.blocks.data() + k * kTileLanes, part.blocks, kLayerBytes);
        owned.ranges[static_cast<std::size_t>(k)] = {*part.blocks, *part.blocks};
    }
    part.blocks = owned.blocks.data();
    part.step = kTileLanes;
    return owned;
}

void BlockLayers::write(int z, const Bits* values) {
    assert(heights_.contains(z) && "a layer of the world");
    Owned& owned = own(partOf(z));
    const int k = z & (world::kSectionSize - 1);
    owned.ranges[static_cast<std::size_t>(k)] = packLayer(values, owned.blocks.data() + k * kTileLanes);
}

void BlockLayers::copy(const BlockLayers& from, int z, int count) {
    assert(from.heights_ == heights_ && "passes of one generator");
    for (const int end = z + count; z < end;) {
        const int first = z & (world::kSectionSize - 1);
        const int here = std::min(world::kSectionSize - first, end - z);
        const Part& source = from.partOf(z);
        if (source.step == 0) {
            fillPart(partOf(z), first, here, constantLayer(*source.blocks));
        } else {
            Owned& owned = own(partOf(z));
            std::memcpy(owned.blocks.data() + first * kTileLanes, source.blocks + first * kTileLanes,
                        static_cast<std::size_t>(here) * kLayerBytes);
            std::copy_n(source.own->ranges.begin() + first, here, owned.ranges.begin() + first);
        }
        z += here;
    }
}

void BlockLayers::repeat(int z, int count) {
    const BlockRange blocks = range(z);
    if (blocks.low == blocks.high) return fill(z + 1, count - 1, blocks.low);
    const std::uint16_t* first = layer(z);
    for (int k = z + 1; k < z + count; ++k) {
        Owned& owned = own(partOf(k));
        const auto at = static_cast<std::size_t>(k & (world::kSectionSize - 1));
        std::memcpy(owned.blocks.data() + at * kTileLanes, first, kLayerBytes);
        owned.ranges[at] = blocks;
    }
}

void BlockLayers::compact() {
    for (int number = heights_.firstSection(); number < heights_.endSection(); ++number) {
        Part& part = partOf(number * world::kSectionSize);
        const auto block = part.own ? uniformBlock(number) : std::nullopt;
        if (!block) continue;
        part = {constantLayer(*block), nullptr, 0, kAllLayers};
    }
    spare_.clear();
    spare_.shrink_to_fit();
}

std::size_t BlockLayers::memoryBytes() const {
    const auto owned = static_cast<std::size_t>(
        std::count_if(parts_.begin(), parts_.end(), [](const Part& part) { return part.own != nullptr; }));
    return sizeof(*this) + parts_.size() * sizeof(Part) + constants_.size() * sizeof(Layer) +
           (owned + spare_.size()) * sizeof(Owned);
}

}  // namespace terrane::gen
