#include "terrane/gen/cpu/shape_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>
#include <tuple>

namespace terrane::gen {
namespace {

// A block of the shape as the table has it.
struct Voxel {
    int rank, z, y, x;
    world::BlockId block;
};

std::vector<Voxel> voxelsByRank(const VoxelShape& shape, const world::BlockRegistry& blocks) {
    std::vector<world::BlockId> ids;
    for (const ShapeBlock& b : shape.blocks) ids.push_back(blocks.find(b.name)->id);
    std::vector<Voxel> voxels;
    for (const ShapeVoxel& v : shape.voxels) {
        voxels.push_back({shape.blocks[v.block].rank, v.z, v.y, v.x, ids[v.block]});
    }
    std::sort(voxels.begin(), voxels.end(), [](const Voxel& a, const Voxel& b) {
        return std::tie(a.rank, a.z, a.y, a.x) < std::tie(b.rank, b.z, b.y, b.x);
    });
    return voxels;
}

bool continues(const ShapeRun& run, const Voxel& v) {
    return run.block == v.block && run.z == v.z && run.y == v.y && run.x + run.length == v.x;
}

void widen(ShapeRecord& record, const Voxel& v, bool isFirst) {
    const std::array<int, 3> at = {v.x, v.y, v.z};
    for (std::size_t k = 0; k < 3; ++k) {
        record.low[k] = static_cast<std::int8_t>(isFirst ? at[k] : std::min<int>(record.low[k], at[k]));
        record.high[k] = static_cast<std::int8_t>(isFirst ? at[k] : std::max<int>(record.high[k], at[k]));
    }
}

std::uint32_t sizeOf(const ShapeRecord& shape, std::size_t axis) {
    return static_cast<std::uint32_t>(shape.high[axis] - shape.low[axis] + 1);
}

std::uint32_t cellsOf(const ShapeRecord& shape) {
    return sizeOf(shape, 0) * sizeOf(shape, 1) * sizeOf(shape, 2);
}

// A word of the palette: a block with its rank.
std::uint32_t paletteWord(world::BlockId block, std::size_t rank) {
    return block | static_cast<std::uint32_t>(rank) << 16;
}

std::vector<std::uint32_t> paletteOf(const ShapeTable& table) {
    std::set<std::uint32_t> words;
    for (const ShapeRecord& shape : table.shapes) {
        for (std::size_t rank = 0; rank <= kMaxShapeRank; ++rank) {
            for (std::uint32_t k = shape.firstRun[rank]; k < shape.firstRun[rank + 1]; ++k) {
                words.insert(paletteWord(table.runs[k].block, rank));
            }
        }
    }
    return {words.begin(), words.end()};
}

// Cell of a run's first voxel, counted from the shape's first cell.
std::uint32_t cellOf(const ShapeRecord& shape, const ShapeRun& run) {
    const auto from = [&](int at, std::size_t axis) {
        return static_cast<std::uint32_t>(at - shape.low[axis]);
    };
    return (from(run.z, 2) * sizeOf(shape, 1) + from(run.y, 1)) * sizeOf(shape, 0) + from(run.x, 0);
}

void writeCells(std::vector<std::uint32_t>& words, std::uint32_t at, std::uint32_t count,
                std::uint32_t number) {
    for (std::uint32_t k = at; k < at + count; ++k) words[k / 4] |= number << k % 4 * 8;
}

std::string voxelMistake(const VoxelShape& shape, const ShapeVoxel& v) {
    const auto place = [&] { return fmt::format("voxel ({}, {}, {})", v.x, v.y, v.z); };
    if (std::max(std::abs(v.x), std::abs(v.y)) > kMaxShapeReach)
        return fmt::format("{} is beyond {} blocks of the foot", place(), kMaxShapeReach);
    if (v.z < kMinShapeZ || v.z > kMaxShapeZ)
        return fmt::format("{}: z is not in {}…{}", place(), kMinShapeZ, kMaxShapeZ);
    if (v.block >= shape.blocks.size())
        return fmt::format("{} has block {} of {}", place(), v.block, shape.blocks.size());
    return "";
}

}  // namespace

std::string shapeMistake(const VoxelShape& shape, const world::BlockRegistry& blocks) {
    if (shape.voxels.empty()) return "has no voxels";
    for (const ShapeBlock& b : shape.blocks) {
        const world::BlockType* type = blocks.find(b.name);
        if (!type) return fmt::format("unknown block \"{}\"", b.name);
        if (type->id == world::kAir) return "has voxels of air: leave them out";
        if (b.rank < 0 || b.rank > kMaxShapeRank)
            return fmt::format("rank {} is not in 0…{}", b.rank, kMaxShapeRank);
    }
    constexpr int kSide = 2 * kMaxShapeReach + 1, kLayers = kMaxShapeZ - kMinShapeZ + 1;
    std::vector<bool> isTaken(std::size_t{kSide} * kSide * kLayers);
    for (const ShapeVoxel& v : shape.voxels) {
        if (std::string mistake = voxelMistake(shape, v); !mistake.empty()) return mistake;
        const int row = (v.z - kMinShapeZ) * kSide + v.y + kMaxShapeReach;
        const auto at = static_cast<std::size_t>(row * kSide + v.x + kMaxShapeReach);
        if (isTaken[at]) return fmt::format("voxel ({}, {}, {}) is there twice", v.x, v.y, v.z);
        isTaken[at] = true;
    }
    const auto isFoot = [](const ShapeVoxel& v) { return v.x == 0 && v.y == 0; };
    if (std::none_of(shape.voxels.begin(), shape.voxels.end(), isFoot)) {
        return "has no voxel at x = y = 0, its foot, which wide columns join the rest to";
    }
    return "";
}

void addShape(ShapeTable& table, const VoxelShape& shape, int level, const world::BlockRegistry& blocks) {
    const std::vector<Voxel> voxels = voxelsByRank(coarsened(shape, level), blocks);
    assert(!voxels.empty() && "shapeMistake demands a foot, which every level keeps");
    ShapeRecord record;
    std::size_t next = 0;
    for (int rank = 0; rank <= kMaxShapeRank; ++rank) {
        const std::size_t first = table.runs.size();
        record.firstRun[static_cast<std::size_t>(rank)] = static_cast<std::uint32_t>(first);
        for (; next < voxels.size() && voxels[next].rank == rank; ++next) {
            const Voxel& v = voxels[next];
            widen(record, v, next == 0);
            if (table.runs.size() > first && continues(table.runs.back(), v)) {
                ++table.runs.back().length;
                continue;
            }
            table.runs.push_back({static_cast<std::int8_t>(v.x), static_cast<std::int8_t>(v.y),
                                  static_cast<std::int8_t>(v.z), 1, v.block});
        }
    }
    record.firstRun.back() = static_cast<std::uint32_t>(table.runs.size());
    table.shapes.push_back(record);
}

std::size_t shapeCellBytes(const ShapeTable& table) {
    std::size_t bytes = 0;
    for (const ShapeRecord& shape : table.shapes) bytes += cellsOf(shape);
    return bytes;
}

std::size_t shapePaletteSize(const ShapeTable& table) {
    return paletteOf(table).size();
}

std::vector<std::uint32_t> shapeWords(const ShapeTable& table) {
    const std::vector<std::uint32_t> palette = paletteOf(table);
    assert(palette.size() < shared::kShapePaletteWords && "GeneratorBuilder::finish() refuses more");
    std::vector<std::uint32_t> words(1 + shared::kShapePaletteWords);
    words[0] = static_cast<std::uint32_t>(table.shapes.size());
    std::copy(palette.begin(), palette.end(), words.begin() + 2);  // cell 0 is empty
    auto cell = static_cast<std::uint32_t>(4 * (words.size() + 4 * table.shapes.size()));
    for (const ShapeRecord& s : table.shapes) {
        const auto from = [&](std::size_t axis) { return static_cast<std::uint32_t>(s.low[axis] + 32); };
        words.push_back(from(0) | from(1) << 8 | from(2) << 16);
        words.push_back(sizeOf(s, 0) | sizeOf(s, 1) << 8 | sizeOf(s, 2) << 16);
        words.push_back(cell);
        words.push_back(0);
        cell += cellsOf(s);
    }
    words.resize((cell + 3) / 4);
    for (std::size_t n = 0; n < table.shapes.size(); ++n) {
        const ShapeRecord& shape = table.shapes[n];
        const std::uint32_t first = words[1 + shared::kShapePaletteWords + 4 * n + 2];
        for (std::size_t rank = 0; rank <= kMaxShapeRank; ++rank) {
            for (std::uint32_t k = shape.firstRun[rank]; k < shape.firstRun[rank + 1]; ++k) {
                const ShapeRun& run = table.runs[k];
                const auto entry =
                    std::lower_bound(palette.begin(), palette.end(), paletteWord(run.block, rank));
                const auto number = static_cast<std::uint32_t>(entry - palette.begin() + 1);
                writeCells(words, first + cellOf(shape, run), run.length, number);
            }
        }
    }
    return words;
}

}  // namespace terrane::gen
