#include "bench/level_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace terrane::bench {
namespace {

using world::ChunkPos;

constexpr std::array<const char*, kCoverCount> kCoverNames = {"grass", "stone",  "sand",  "snow", "dirt",
                                                              "water", "leaves", "wheat", "other"};
constexpr std::array<const char*, kLandCount> kLandNames = {"ocean", "plains", "hills", "mountains",
                                                            "desert"};
// Shares of leaves in an area of chunks: the densities of forest at which crowns are compared.
constexpr std::array<double, 4> kForestFrom = {0.005, 0.1, 0.3, 0.5};

// A square of columns within an area.
struct Window {
    int x, y, side;
};

template <class Use>
void forEachColumn(const Columns& columns, Window window, Use use) {
    for (int y = window.y; y < window.y + window.side; ++y) {
        for (int x = window.x; x < window.x + window.side; ++x)
            use(static_cast<std::size_t>(x + columns.width * y));
    }
}

double shareOf(const Columns& columns, Window window, Cover cover) {
    double count = 0;
    forEachColumn(columns, window, [&](std::size_t k) { count += columns.cover[k] == cover; });
    return count / (window.side * window.side);
}

// Cave mouths, which tiles do not have: ground far below that of all columns kReach blocks away.
bool isPit(const Columns& columns, std::size_t k) {
    constexpr int kReach = 6, kDepth = 4;
    const int x = static_cast<int>(k) % columns.width, y = static_cast<int>(k) / columns.width;
    int lowest = world::kHighestTop;
    for (const auto& [dx, dy] : {std::pair(-kReach, 0), {kReach, 0}, {0, -kReach}, {0, kReach}}) {
        const int ox = std::clamp(x + dx, 0, columns.width - 1),
                  oy = std::clamp(y + dy, 0, columns.width - 1);
        lowest = std::min<int>(lowest, columns.ground[static_cast<std::size_t>(ox + columns.width * oy)]);
    }
    return columns.ground[k] < lowest - kDepth;
}

struct Heights {
    double mean = 0, variance = 0;
};

Heights heightsOf(const Columns& columns, Window window) {
    double sum = 0, squares = 0, count = 0;
    forEachColumn(columns, window, [&](std::size_t k) {
        if (columns.step == 1 && isPit(columns, k)) return;
        const double ground = columns.ground[k];
        sum += ground;
        squares += ground * ground;
        count += 1;
    });
    return {sum / count, squares / count - (sum / count) * (sum / count)};
}

Land landOf(const Columns& chunks, Window window) {
    const Heights heights = heightsOf(chunks, window);
    if (shareOf(chunks, window, Cover::Water) > 0.5) return Land::Ocean;
    if (shareOf(chunks, window, Cover::Sand) > 0.5) return Land::Desert;
    if (heights.mean >= 115) return Land::Mountains;
    return heights.variance > 16 ? Land::Hills : Land::Plains;
}

void addArea(LevelFigures& figures, const Columns& chunks, const Columns& tile, Window window, int level) {
    const Window inTile = {window.x >> level, window.y >> level, window.side >> level};
    const auto land = static_cast<std::size_t>(landOf(chunks, window));
    figures.areas[land] += 1;
    figures.heightBias[land] += heightsOf(tile, inTile).mean - heightsOf(chunks, window).mean;
    const double crowns = shareOf(chunks, window, Cover::Leaves);
    const auto density =
        std::upper_bound(kForestFrom.begin(), kForestFrom.end(), crowns) - kForestFrom.begin();
    if (density == 0) return;
    figures.chunkCrowns[static_cast<std::size_t>(density) - 1] += crowns;
    figures.tileCrowns[static_cast<std::size_t>(density) - 1] += shareOf(tile, inTile, Cover::Leaves);
}

void addWater(LevelFigures& figures, const Columns& chunks, const Columns& tile, int level) {
    for (int k = 0; k < tile.width * tile.width; ++k) {
        const Window cell = {k % tile.width << level, k / tile.width << level, 1 << level};
        const bool inChunks = shareOf(chunks, cell, Cover::Water) >= 0.5;
        const bool inTile = tile.cover[static_cast<std::size_t>(k)] == Cover::Water;
        figures.waterInBoth += inChunks && inTile;
        figures.waterInAny += inChunks || inTile;
    }
}

void addCover(std::array<double, kCoverCount>& shares, const Columns& columns) {
    for (const Cover cover : columns.cover) {
        shares[static_cast<std::size_t>(cover)] += 1.0 / static_cast<double>(columns.cover.size());
    }
}

// Sum of the heights of crowns above the ground, and their number.
struct CrownSum {
    double height = 0, count = 0;

    void add(const Columns& columns) {
        for (std::size_t k = 0; k < columns.cover.size(); ++k) {
            if (columns.cover[k] != Cover::Leaves) continue;
            height += columns.crown[k] - columns.ground[k];
            count += 1;
        }
    }
    double mean() const { return count > 0 ? height / count : 0; }
};

}  // namespace

LevelComparison::LevelComparison(const gen::LevelGenerators& generators, const world::BlockRegistry& blocks,
                                 FigureArea area)
    : generators_(generators), area_(std::move(area)) {
    for (const world::BlockType& type : blocks.types()) {
        covers_.resize(std::max<std::size_t>(covers_.size(), std::size_t{type.id} + 1));
        isSeen_.resize(covers_.size());
        covers_[type.id] = coverOf(type.name);
        isSeen_[type.id] = type.opaqueCube || covers_[type.id] != Cover::Other;
    }
    for (const ChunkPos corner : area_.corners) chunks_.push_back(columnsOf(corner, area_.side, 0));
}

Cover LevelComparison::coverOf(const std::string& name) const {
    const std::string known = name == "oak_leaves" || name == "oak_log" ? "leaves" : name;
    const auto at = std::find(kCoverNames.begin(), kCoverNames.end(), known);
    return at == kCoverNames.end() ? Cover::Other : static_cast<Cover>(at - kCoverNames.begin());
}

Columns LevelComparison::columnsOf(ChunkPos corner, int side, int level) const {
    Columns columns;
    columns.width = side * world::kChunkSize;
    columns.step = world::columnWidth(level);
    const auto count = static_cast<std::size_t>(columns.width) * static_cast<std::size_t>(columns.width);
    columns.cover.resize(count, Cover::Other);
    columns.ground.resize(count);
    columns.crown.resize(count);
    for (int n = 0; n < side * side; ++n) {
        const world::Chunk chunk = generators_.generate(
            {corner.x + n % side, corner.y + n / side, static_cast<std::uint8_t>(level)});
        for (int c = 0; c < 256; ++c) {
            const int x = n % side * 16 + c % 16, y = n / side * 16 + c / 16;
            const auto k = static_cast<std::size_t>(x + columns.width * y);
            bool isCovered = false;
            for (int z = chunk.heights().top - 1; z >= chunk.heights().bottom; --z) {
                const world::BlockId block = chunk.block(world::blockIndex(c % 16, c / 16, z));
                if (block == world::kAir || !isSeen_[block]) continue;
                const Cover cover = covers_[block];
                if (!isCovered) columns.cover[k] = cover;
                isCovered = true;
                if (cover == Cover::Leaves)
                    columns.crown[k] = std::max(columns.crown[k], static_cast<std::int16_t>(z));
                if (cover == Cover::Leaves || cover == Cover::Water || cover == Cover::Wheat) continue;
                columns.ground[k] = static_cast<std::int16_t>(z);
                break;
            }
        }
    }
    return columns;
}

LevelFigures LevelComparison::of(int level) const {
    LevelFigures figures;
    CrownSum chunkCrowns, tileCrowns;
    for (std::size_t n = 0; n < chunks_.size(); ++n) {
        const Columns& chunks = chunks_[n];
        const ChunkPos corner = area_.corners[n];
        const Columns tile = columnsOf({corner.x >> level, corner.y >> level}, area_.side >> level, level);
        figures.columns += static_cast<double>(tile.cover.size());
        addCover(figures.chunkCover, chunks);
        addCover(figures.tileCover, tile);
        addWater(figures, chunks, tile, level);
        chunkCrowns.add(chunks);
        tileCrowns.add(tile);
        for (int k = 0; k < chunks.width / kAreaBlocks * (chunks.width / kAreaBlocks); ++k) {
            const int across = chunks.width / kAreaBlocks;
            addArea(figures, chunks, tile, {k % across * kAreaBlocks, k / across * kAreaBlocks, kAreaBlocks},
                    level);
        }
    }
    figures.chunkCrownHeight = chunkCrowns.mean();
    figures.tileCrownHeight = tileCrowns.mean();
    for (double& share : figures.chunkCover) share /= static_cast<double>(chunks_.size());
    for (double& share : figures.tileCover) share /= static_cast<double>(chunks_.size());
    for (std::size_t k = 0; k < kLandCount; ++k) figures.heightBias[k] /= std::max(1.0, figures.areas[k]);
    return figures;
}

std::string coverTable(const std::vector<LevelFigures>& levels) {
    std::string text = fmt::format("{:6}", "level");
    for (const char* name : kCoverNames) text += fmt::format("{:>9}", name);
    text += "   (share of the area, %)\n";
    const auto line = [&](const std::string& name, const std::array<double, kCoverCount>& shares) {
        text += fmt::format("{:6}", name);
        for (const double share : shares) text += fmt::format("{:9.2f}", share * 100);
        text += "\n";
    };
    if (!levels.empty()) line("chunks", levels.front().chunkCover);
    for (std::size_t k = 0; k < levels.size(); ++k) line(fmt::format("{}", k + 1), levels[k].tileCover);
    return text;
}

std::string landTable(const std::vector<LevelFigures>& levels) {
    std::string text = fmt::format("{:6}", "level");
    for (const char* name : kLandNames) text += fmt::format("{:>10}", name);
    text += "   water IoU   crowns at 0.5-10, 10-30, 30-50, 50+ % (tile / chunks)   crown height\n";
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const LevelFigures& f = levels[k];
        text += fmt::format("{:<6}", k + 1);
        for (const double bias : f.heightBias) text += fmt::format("{:10.2f}", bias);
        text += fmt::format("{:12.3f}   ", f.waterInAny > 0 ? f.waterInBoth / f.waterInAny : 1.0);
        for (std::size_t d = 0; d < f.chunkCrowns.size(); ++d) {
            text += fmt::format("{:10.3f}", f.chunkCrowns[d] > 0 ? f.tileCrowns[d] / f.chunkCrowns[d] : 1.0);
        }
        text += fmt::format("      {:.2f} / {:.2f}\n", f.tileCrownHeight, f.chunkCrownHeight);
    }
    return text;
}

}  // namespace terrane::bench
