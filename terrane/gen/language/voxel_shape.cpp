#include "terrane/gen/language/voxel_shape.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace terrane::gen {
namespace {

// Beyond this step leaves reach down to the ground in place of trunks that are much thinner than a column.
constexpr int kMaxWoodStep = 2;

// Size of the grid: all places and a margin of one on each side.
constexpr int kGridSide = 2 * kMaxShapeReach + 3, kGridLayers = kMaxShapeZ - kMinShapeZ + 3;

using ColumnAt = std::pair<int, int>;  // y, x: the order in which equal columns are chosen

// Pairs of a block and its number of voxels.
using BlockCounts = std::vector<std::pair<int, int>>;

void count(BlockCounts& counts, int block) {
    const auto known =
        std::find_if(counts.begin(), counts.end(), [&](const auto& entry) { return entry.first == block; });
    if (known == counts.end()) return static_cast<void>(counts.emplace_back(block, 1));
    ++known->second;
}

// The block that most voxels have; of equal ones the first of the shape.
int mostFrequent(const BlockCounts& counts) {
    const auto isLess = [](const auto& a, const auto& b) {
        return a.second != b.second ? a.second < b.second : a.first > b.first;
    };
    return std::max_element(counts.begin(), counts.end(), isLess)->first;
}

// Voxels in a layer of a wide column.
struct LayerCount {
    int filled = 0;
    BlockCounts byBlock;
};

struct WideColumn {
    std::vector<ColumnAt> covered;  // blocks
    std::map<int, LayerCount> layers;
};

using WideColumns = std::map<ColumnAt, WideColumn>;

// The foot lies in the middle of its column, at the block that a column is sampled at.
int columnOf(int blocks, int level) {
    return (blocks + (1 << level) / 2) >> level;
}

WideColumns gather(const VoxelShape& shape, int level) {
    WideColumns columns;
    for (const ShapeVoxel& v : shape.voxels) {
        WideColumn& column = columns[{columnOf(v.y, level), columnOf(v.x, level)}];
        column.covered.push_back({v.y, v.x});
        LayerCount& layer = column.layers[v.z];
        ++layer.filled;
        count(layer.byBlock, v.block);
    }
    for (auto& [at, column] : columns) {
        auto& covered = column.covered;
        std::sort(covered.begin(), covered.end());
        covered.erase(std::unique(covered.begin(), covered.end()), covered.end());
    }
    return columns;
}

// The columns with the largest covered area, as many as have the shape's area, and always the foot's.
std::vector<ColumnAt> fullest(const WideColumns& columns, int level) {
    const int area = 1 << (2 * level);
    int covered = 0;
    std::vector<std::pair<int, ColumnAt>> order;
    for (const auto& [at, column] : columns) {
        const int count = static_cast<int>(column.covered.size());
        covered += count;
        order.push_back({at == ColumnAt{0, 0} ? -2 * area : -count, at});
    }
    std::sort(order.begin(), order.end());
    const int chosenCount = std::max(1, (covered + area / 2) / area);
    std::vector<ColumnAt> chosen;
    for (int k = 0; k < std::min<int>(chosenCount, static_cast<int>(order.size())); ++k) {
        chosen.push_back(order[static_cast<std::size_t>(k)].second);
    }
    return chosen;
}

class Coarsener {
  public:
    Coarsener(const VoxelShape& shape, int level) : shape_(shape), level_(level) {}

    VoxelShape run() {
        const WideColumns columns = gather(shape_, level_);
        result_ = {shape_.name, shape_.blocks, {}};
        for (const ColumnAt& at : fullest(columns, level_)) {
            const auto found = columns.find(at);
            if (found == columns.end()) continue;
            at == ColumnAt{0, 0} ? addFoot(found->second) : addColumn(at, found->second);
        }
        removeDisconnected();
        return std::move(result_);
    }

  private:
    void add(ColumnAt at, int z, int block) {
        result_.voxels.push_back({static_cast<std::int8_t>(at.second), static_cast<std::int8_t>(at.first),
                                  static_cast<std::int8_t>(z), static_cast<std::uint8_t>(block)});
    }

    // Keeps a layer if it fills a quarter of the covered area.
    void addColumn(ColumnAt at, const WideColumn& column) {
        for (const auto& [z, layer] : column.layers) {
            if (4 * layer.filled >= static_cast<int>(column.covered.size()))
                add(at, z, mostFrequent(layer.byBlock));
        }
    }

    // Without gaps from the lowest voxel to the highest.
    void addFoot(const WideColumn& column) {
        BlockCounts crown;
        for (const ShapeVoxel& v : shape_.voxels) {
            if (!isWood(v.block)) count(crown, v.block);
        }
        LayerCount below = column.layers.begin()->second;
        for (int z = column.layers.begin()->first; z <= column.layers.rbegin()->first; ++z) {
            const auto layer = column.layers.find(z);
            if (layer != column.layers.end()) below = layer->second;
            add({0, 0}, z, isTooThick(below) && !crown.empty() ? mostFrequent(crown) : footBlock(below));
        }
    }

    // Whether wood as wide as the column would be far thicker than the trunk is.
    bool isTooThick(const LayerCount& layer) const {
        int wood = 0;
        for (const auto& [block, count] : layer.byBlock) wood += isWood(block) ? count : 0;
        return (1 << level_) > kMaxWoodStep && 2 * wood < 1 << (2 * level_);
    }

    int footBlock(const LayerCount& layer) const {
        for (const auto& [block, count] : layer.byBlock) {
            if (isWood(block)) return block;
        }
        return mostFrequent(layer.byBlock);
    }

    bool isWood(int block) const { return shape_.blocks[static_cast<std::size_t>(block)].rank > 0; }

    // Removes voxels that are not connected to the foot's column by faces, edges or corners.
    void removeDisconnected() {
        enum State : std::uint8_t { kEmpty, kLoose, kJoined };
        std::vector<State> states(std::size_t{kGridSide} * kGridSide * kGridLayers, kEmpty);
        const auto stateAt = [&](int x, int y, int z) -> State& {
            const int row = (z - kMinShapeZ + 1) * kGridSide + y + kMaxShapeReach + 1;
            return states[static_cast<std::size_t>(row * kGridSide + x + kMaxShapeReach + 1)];
        };
        std::vector<ShapeVoxel> open;
        for (const ShapeVoxel& v : result_.voxels) {
            const bool isFoot = v.x == 0 && v.y == 0;
            stateAt(v.x, v.y, v.z) = isFoot ? kJoined : kLoose;
            if (isFoot) open.push_back(v);
        }
        while (!open.empty()) {
            const ShapeVoxel at = open.back();
            open.pop_back();
            for (int n = 0; n < 27; ++n) {
                const int x = at.x + n % 3 - 1, y = at.y + n / 3 % 3 - 1, z = at.z + n / 9 - 1;
                if (stateAt(x, y, z) != kLoose) continue;
                stateAt(x, y, z) = kJoined;
                open.push_back({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y),
                                static_cast<std::int8_t>(z), 0});
            }
        }
        std::erase_if(result_.voxels, [&](const ShapeVoxel& v) { return stateAt(v.x, v.y, v.z) == kLoose; });
    }

    const VoxelShape& shape_;
    int level_;
    VoxelShape result_;
};

}  // namespace

VoxelShape coarsened(const VoxelShape& shape, int level) {
    if (level == 0 || shape.voxels.empty()) return shape;
    return Coarsener(shape, level).run();
}

ShapeStatistics statisticsOf(const VoxelShape& shape) {
    std::set<ColumnAt> covered;
    ShapeStatistics statistics;
    for (const ShapeVoxel& v : shape.voxels) {
        covered.insert({v.y, v.x});
        statistics.height = std::max<int>(statistics.height, v.z);
    }
    statistics.cover = static_cast<int>(covered.size());
    return statistics;
}

}  // namespace terrane::gen
