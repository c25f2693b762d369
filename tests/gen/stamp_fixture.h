// Random shapes on random feet, as a generator and as plain functions of the position.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "terrane/gen/language/builder.h"
#include "terrane/gen/noise/sample_grid.h"

namespace terrane::gen {

// Voxels anywhere within the bounds; the first one at a corner of them.
inline VoxelShape randomShape(std::uint32_t seed, int reach, std::size_t voxels) {
    std::mt19937 random(seed);
    const auto between = [&](int low, int high) {
        return low + static_cast<int>(random() % static_cast<std::uint32_t>(high - low + 1));
    };
    VoxelShape shape = {"random", {{"stone", 0}, {"dirt", 1}, {"water", 1}, {"stone", 3}}, {}};
    std::vector<bool> isTaken(std::size_t{33} * 33 * 57);
    const auto add = [&](int x, int y, int z, int block) {
        const auto at = static_cast<std::size_t>(((z + 8) * 33 + y + 16) * 33 + x + 16);
        if (isTaken[at]) return;
        isTaken[at] = true;
        shape.voxels.push_back({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y),
                                static_cast<std::int8_t>(z), static_cast<std::uint8_t>(block)});
    };
    add(reach, -reach, seed % 2 == 0 ? kMaxShapeZ : kMinShapeZ, 3);
    add(0, 0, 0, 1);
    for (std::size_t k = 0; k < voxels; ++k) {
        add(between(-reach, reach), between(-reach, reach), between(-4, 12), between(0, 3));
    }
    return shape;
}

inline std::vector<VoxelShape> stampShapes() {
    return {randomShape(1, 16, 900), randomShape(2, 3, 80), randomShape(3, 7, 300), randomShape(4, 0, 1)};
}

// Which shape has its foot in a column, and where: -1, a shape, or a number that is none.
struct StampLand {
    std::int32_t share;      // of 4096 columns
    std::int32_t place = 0;  // lands of different ones have different feet
    std::int32_t number(std::uint32_t x, std::uint32_t y) const {
        const std::uint32_t h = mix(x + static_cast<std::uint32_t>(place), y);
        if (static_cast<std::int32_t>(h >> 8 & 4095) >= share) return -1;
        return static_cast<std::int32_t>(h >> 24 & 7) - 1;
    }
    std::int32_t base(std::uint32_t x, std::uint32_t y) const {
        const std::uint32_t h = mix(x + static_cast<std::uint32_t>(place) + 77, y);
        // Some stand across the world's lowest and highest layers, some far outside.
        switch (h >> 28 & 7) {
            case 0:
                return static_cast<std::int32_t>(h >> 8 & 63) - 55;
            case 1:
                return static_cast<std::int32_t>(h >> 8 & 31) + 240;
            case 2:
                return static_cast<std::int32_t>(h << 4);
            default:
                return static_cast<std::int32_t>(h >> 8 & 31) + 60;
        }
    }

    void write(Pass& p, Field<Int> number, Field<Int> base) const {
        const Int x = p.x() + place, h = mix(x, p.y()), g = mix(x + 77, p.y());
        p.set(number, select(((h >> 8) & 4095) >= share, Int(-1), ((h >> 24) & 7) - 1));
        const Int kind = (g >> 28) & 7;
        p.set(base, multiSelect<Int>({{kind == 0, ((g >> 8) & 63) - 55},
                                      {kind == 1, ((g >> 8) & 31) + 240},
                                      {kind == 2, g << 4}},
                                     ((g >> 8) & 31) + 60));
    }

  private:
    template <class T>
    static T mix(T x, T y) {
        const T a = x * T(0x2C1B3C6D) + y * T(0x297A2D39);
        const T b = (a ^ ((a >> 15) & T(0x1FFFF))) * T(0x5851F42D);
        return b ^ ((b >> 13) & T(0x7FFFF));
    }
};

// Two lands of shapes in one pass; what stands is mixed so that both show.
inline void writeStamps(GeneratorBuilder& g, const StampLand& dense, const StampLand& sparse) {
    const auto number = g.field<Int>("number"), base = g.field<Int>("base");
    const auto number2 = g.field<Int>("number 2"), base2 = g.field<Int>("base 2");
    for (const VoxelShape& shape : stampShapes()) g.shape(shape);
    g.pass2D("feet", [&](Pass& p) {
        dense.write(p, number, base);
        sparse.write(p, number2, base2);
    });
    g.pass3D("stamps", [&](Pass& p) {
        const Block first = p.stamp(number, base), second = p.stamp(number2, base2);
        p.setBlock(select(first == p.block("air"), second, first));
    });
}

// Feet as far below and above the world as their shapes reach into it: stone at height 0 where x is even, at
// 255 where it is odd.
inline void writeStampsAtTheEnds(GeneratorBuilder& g) {
    const auto number = g.field<Int>("number"), base = g.field<Int>("base");
    g.shape({"high", {{"stone", 0}}, {{0, 0, kMaxShapeZ, 0}}});
    g.shape({"low", {{"stone", 0}}, {{0, 0, kMinShapeZ, 0}}});
    g.pass2D("feet", [&](Pass& p) {
        p.set(number, p.x() & 1);
        p.set(base, select((p.x() & 1) == 0, Int(-kMaxShapeZ), Int(255 - kMinShapeZ)));
    });
    g.pass3D("stamps", [&](Pass& p) { p.setBlock(p.stamp(number, base)); });
}

// The block at one voxel, from a search of every shape within reach.
class SlowStamps {
  public:
    SlowStamps(const world::BlockRegistry& blocks, world::ChunkPos chunk, const StampLand& land)
        : blocks_(blocks) {
        for (const VoxelShape& shape : stampShapes()) shapes_.push_back(coarsened(shape, chunk.level));
        const SampleGrid grid = sampleGrid(chunk);
        for (int y = -16; y < 32; ++y) {
            for (int x = -16; x < 32; ++x) {
                const auto px =
                    static_cast<std::uint32_t>(grid.x) + static_cast<std::uint32_t>(x * grid.step);
                const auto py =
                    static_cast<std::uint32_t>(grid.y) + static_cast<std::uint32_t>(y * grid.step);
                const std::int32_t number = land.number(px, py);
                if (number < 0 || number >= static_cast<std::int32_t>(shapes_.size())) continue;
                feet_.push_back({x, y, land.base(px, py), &shapes_[static_cast<std::size_t>(number)]});
            }
        }
    }

    // x and y are columns in the chunk.
    world::BlockId block(int x, int y, int z) const {
        int best = -1;
        world::BlockId result = world::kAir;
        for (const Foot& foot : feet_) {  // by y, then x: the first one stays
            for (const ShapeVoxel& v : foot.shape->voxels) {
                const ShapeBlock& block = foot.shape->blocks[v.block];
                const bool isHere = foot.x + v.x == x && foot.y + v.y == y && std::int64_t{foot.z} + v.z == z;
                if (!isHere || block.rank <= best) continue;
                best = block.rank;
                result = blocks_.find(block.name)->id;
            }
        }
        return result;
    }

  private:
    struct Foot {
        int x, y;
        std::int32_t z;
        const VoxelShape* shape;
    };
    const world::BlockRegistry& blocks_;
    std::vector<VoxelShape> shapes_;
    std::vector<Foot> feet_;
};

}  // namespace terrane::gen
