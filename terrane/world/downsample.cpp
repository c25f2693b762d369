#include "terrane/world/downsample.h"

#include <algorithm>
#include <array>

#include "terrane/shared/hash.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::world {
namespace {

using Fill = DownsampleKind::Fill;

Fill fillOf(const BlockType& type) {
    switch (type.shape) {
        case Shape::Cube:
        case Shape::Inset:
            return Fill::Solid;
        case Shape::Liquid:
            return Fill::Liquid;
        case Shape::Model:
            return type.model->isBulky ? Fill::Solid : Fill::Open;
        case Shape::None:
        case Shape::Cross:
        case Shape::Hash:
            return Fill::Open;
    }
    return Fill::Open;
}

// Orders light by the strongest color, then by the sum of all three.
std::uint16_t glowOf(const std::array<std::uint8_t, 3>& emission) {
    const int strongest = std::max({emission[0], emission[1], emission[2]});
    if (strongest < kMinFarEmission) return 0;
    return static_cast<std::uint16_t>(strongest * 64 + emission[0] + emission[1] + emission[2]);
}

std::uint32_t hashOf(ColumnPos at) {
    return shared::hash2(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y),
                         shared::mixBits(at.level));
}

int thresholdOf(std::uint32_t hash) {
    return 1 + static_cast<int>(hash >> 30);
}

// Four blocks of a slice, 16 bits each: one comparison tells whether slices are equal.
using Slice = std::uint64_t;

Slice sliceAt(std::span<const BlockColumn, 4> children, std::size_t z) {
    return Slice{children[0][z]} | Slice{children[1][z]} << 16 | Slice{children[2][z]} << 32 |
           Slice{children[3][z]} << 48;
}

BlockId blockOf(Slice slice, std::size_t child) {
    return static_cast<BlockId>(slice >> (16 * child));
}

// The blocks of a slice with the highest rank, in the order of the hash.
struct Candidates {
    std::array<BlockId, 4> ids;
    std::size_t count = 0;
    int rank = 0;

    void add(BlockId id, int itsRank) {
        if (itsRank < rank) return;
        if (itsRank > rank) count = 0;
        rank = itsRank;
        ids[count++] = id;
    }
    // The most frequent, of equal ones the first. Air if there are none.
    BlockId choose() const {
        if (count == 0) return kAir;
        const auto end = ids.begin() + static_cast<std::ptrdiff_t>(count);
        const auto frequency = [&](BlockId id) { return std::count(ids.begin(), end, id); };
        return count < 3 ? ids[0] : *std::max_element(ids.begin(), end, [&](BlockId a, BlockId b) {
            return frequency(a) < frequency(b);
        });
    }
};

// The block for the slice `slice` under the slice `above`.
BlockId downsampleSlice(const DownsampleRule& rule, Slice slice, Slice above, std::uint32_t hash) {
    if (slice == blockOf(slice, 0) * Slice{0x0001000100010001}) {
        const DownsampleKind& kind = rule.kind(blockOf(slice, 0));
        return kind.fill == Fill::Open && kind.glow == 0 ? kAir : blockOf(slice, 0);
    }
    std::array<DownsampleKind, 4> kinds;
    int solid = 0, liquid = 0;
    bool isLit = false;
    for (std::size_t i = 0; i < 4; ++i) {
        kinds[i] = rule.kind(blockOf(slice, i));
        solid += kinds[i].fill == Fill::Solid;
        liquid += kinds[i].fill == Fill::Liquid;
        isLit = isLit || kinds[i].glow > 0;
    }
    const Fill fill = solid >= thresholdOf(hash)              ? Fill::Solid
                      : liquid > 0 && 2 * liquid >= 4 - solid ? Fill::Liquid
                                                              : Fill::Open;
    if (fill == Fill::Open && !isLit) return kAir;

    Candidates candidates;
    for (std::size_t n = 0; n < 4; ++n) {
        const std::size_t i = n ^ (hash & 3);
        if (isLit) {
            if (kinds[i].glow > 0) candidates.add(blockOf(slice, i), kinds[i].glow);
        } else if (kinds[i].fill == fill) {
            const bool isTop = !rule.kind(blockOf(above, i)).isOpaque;
            const bool isSide = !kinds[i ^ 1].isOpaque || !kinds[i ^ 2].isOpaque;
            candidates.add(blockOf(slice, i), fill == Fill::Liquid ? 0 : isTop ? 2 : isSide);
        }
    }
    return candidates.choose();
}

}  // namespace

DownsampleRule downsampleRule(const BlockRegistry& blocks) {
    DownsampleRule rule;
    rule.kinds.reserve(blocks.types().size());
    for (const BlockType& type : blocks.types()) {
        rule.kinds.push_back({fillOf(type), type.opaqueCube, glowOf(type.emission)});
    }
    return rule;
}

int coverThreshold(ColumnPos parent) {
    return thresholdOf(hashOf(parent));
}

void downsampleColumn(const DownsampleRule& rule, std::span<const BlockColumn, 4> children, ColumnPos parent,
                      BlockColumn& out) {
    out.resize(children[0].size());
    const std::uint32_t hash = hashOf(parent);
    Slice above = 0;  // air over the top
    bool isRepeated = false;
    for (std::size_t z = out.size(); z-- > 0;) {
        const Slice slice = sliceAt(children, z);
        // The result depends on a slice and the one above: the third of equal slices gives the same as the
        // second.
        const bool isSame = slice == above;
        out[z] = isSame && isRepeated ? out[z + 1] : downsampleSlice(rule, slice, above, hash);
        isRepeated = isSame;
        above = slice;
    }
}

}  // namespace terrane::world
