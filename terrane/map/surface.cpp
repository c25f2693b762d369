#include "terrane/map/surface.h"

#include <algorithm>
#include <cstring>

namespace terrane::map {

using world::BlockId;

namespace {

SurfaceKind kindOf(const SurfaceKinds& kinds, BlockId id) {
    return id < kinds.size() ? kinds[id] : SurfaceKind::Ground;
}

bool isAllNothing(const world::Section& section, const SurfaceKinds& kinds) {
    return section.surelyAll([&](BlockId id) { return kindOf(kinds, id) == SurfaceKind::Nothing; });
}

// Scans one chunk from above, layer by layer, in the columns that are not done.
class LookDown {
  public:
    explicit LookDown(const SurfaceKinds& kinds) : kinds_(kinds) {}

    // Drops the columns that are done with this layer.
    void passLayer(int z, std::span<const BlockId, kSurfaceColumns> layer, gen::RequestedColumns& requested) {
        for (std::size_t y = 0; y < kRow; ++y)
            if (requested.rows() >> y & 1u) passRow(z, y * kRow, layer, requested);
        isFirst_ = false;
    }

    const Surface& surface() const { return surface_; }

  private:
    static constexpr std::size_t kRow = world::kChunkSize, kWord = sizeof(std::uint64_t) / sizeof(BlockId);

    // Four columns at a time: most are done or have the same block as in the layer before, which changes
    // nothing.
    void passRow(int z, std::size_t row, std::span<const BlockId, kSurfaceColumns> layer,
                 gen::RequestedColumns& requested) {
        for (std::size_t first = row; first < row + kRow; first += kWord) {
            const std::uint64_t here = wordOf(&layer[first]);
            if (((here ^ wordOf(&before_[first])) & ~wordOf(&isDone_[first])) == 0 && !isFirst_) continue;
            for (std::size_t k = first; k < first + kWord; ++k)
                if (isDone_[k] == 0 && passBlock(z, surface_[k], layer[k])) {
                    isDone_[k] = kDone;
                    requested.drop(k);
                }
            std::memcpy(&before_[first], &here, sizeof(here));
        }
    }

    static std::uint64_t wordOf(const BlockId* columns) {
        std::uint64_t word = 0;
        std::memcpy(&word, columns, sizeof(word));
        return word;
    }

    // Adds a block to a column. True if the column is done.
    bool passBlock(int z, SurfaceColumn& column, BlockId block) const {
        const SurfaceKind kind = kindOf(kinds_, block);
        if (kind == SurfaceKind::Nothing) return false;
        if (column.top == world::kAir) {
            column.top = block;
            column.topZ = static_cast<std::int16_t>(z);
        }
        const bool counts = kind == SurfaceKind::Ground ||
                            (kind == SurfaceKind::Liquid && kindOf(kinds_, column.top) == SurfaceKind::Crown);
        if (!counts) return false;
        column.under = block;
        column.underZ = static_cast<std::int16_t>(z);
        return true;
    }

    static constexpr BlockId kDone = 0xFFFF;  // all bits of a column in a word

    const SurfaceKinds& kinds_;
    std::array<BlockId, kSurfaceColumns> before_{};  // of the last layer, by column
    std::array<BlockId, kSurfaceColumns> isDone_{};  // `under` is known
    bool isFirst_ = true;
    Surface surface_{};
};

}  // namespace

SurfaceKinds surfaceKinds(const world::BlockRegistry& blocks) {
    SurfaceKinds kinds;
    for (const world::BlockType& type : blocks.types()) {
        using enum world::Shape;
        const bool isPlant = type.shape == Cross || type.shape == Hash;
        const bool shines = *std::ranges::max_element(type.emission) > 0;
        if (type.shape == None || (isPlant && !shines))
            kinds.push_back(SurfaceKind::Nothing);
        else if (type.shape == Liquid)
            kinds.push_back(SurfaceKind::Liquid);
        else
            kinds.push_back(isPlant || (type.shape == Cube && !type.opaqueCube) ? SurfaceKind::Crown
                                                                                : SurfaceKind::Ground);
    }
    return kinds;
}

Surface surfaceOf(const world::Chunk& chunk, const SurfaceKinds& kinds) {
    LookDown look(kinds);
    gen::RequestedColumns requested;
    std::array<BlockId, world::kBlocksPerSection> blocks;
    for (int s = chunk.heights().endSection(); s-- > chunk.heights().firstSection();) {
        const world::Section& section = chunk.section(s);
        if (isAllNothing(section, kinds)) continue;
        section.unpack(blocks);
        for (int layer = world::kSectionSize; layer-- > 0;) {
            const auto first = blocks.begin() + static_cast<std::ptrdiff_t>(layer * kSurfaceColumns);
            look.passLayer(s * world::kSectionSize + layer,
                           std::span<const BlockId, kSurfaceColumns>(first, kSurfaceColumns), requested);
            if (requested.rows() == 0) return look.surface();
        }
    }
    return look.surface();
}

Surface surfaceOf(const gen::Generator& generator, world::ChunkPos pos, const SurfaceKinds& kinds) {
    LookDown look(kinds);
    generator.generateTopDown(pos, [&](int z, auto layer, gen::RequestedColumns& requested) {
        look.passLayer(z, layer, requested);
    });
    return look.surface();
}

}  // namespace terrane::map
