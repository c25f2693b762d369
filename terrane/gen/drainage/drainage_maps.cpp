#include "terrane/gen/drainage/drainage_maps.h"

#include <algorithm>
#include <bit>
#include <list>
#include <mutex>
#include <optional>

#include "terrane/base/profile.h"
#include "terrane/gen/drainage/drainage_curves.h"

namespace terrane::gen {

// A region that is or is being made.
struct KeptRegion {
    DrainageCell corner;
    std::once_flag made;
    std::optional<DrainageRegion> region;
    std::size_t bytes = 0;  // of the region once it is made
};

struct DrainageMaps::Map {
    Map(const DrainageGraph& graph, std::uint64_t worldSeed) : heights(graph, worldSeed) {}

    std::shared_ptr<KeptRegion> find(DrainageCell corner);
    std::shared_ptr<KeptRegion> region(DrainageCell corner);
    void forgetOldest();

    DrainageHeights heights;
    std::mutex mutex;
    std::list<std::shared_ptr<KeptRegion>> kept;  // most recently used first
};

std::shared_ptr<KeptRegion> DrainageMaps::Map::find(DrainageCell corner) {
    const std::lock_guard lock(mutex);
    const auto isHere = [&](const auto& r) { return r->corner.x == corner.x && r->corner.y == corner.y; };
    const auto known = std::find_if(kept.begin(), kept.end(), isHere);
    if (known != kept.end()) {
        kept.splice(kept.begin(), kept, known);
        return kept.front();
    }
    kept.push_front(std::make_shared<KeptRegion>());
    kept.front()->corner = corner;
    forgetOldest();
    return kept.front();
}

// Called with the mutex held.
void DrainageMaps::Map::forgetOldest() {
    std::size_t bytes = 0;
    for (const auto& r : kept) bytes += r->bytes;
    while (kept.size() > 1 && (kept.size() > kMaxCachedRegions || bytes > kMaxCachedRegionBytes)) {
        bytes -= kept.back()->bytes;
        kept.pop_back();
    }
}

// If making the region throws, the next caller makes it.
std::shared_ptr<KeptRegion> DrainageMaps::Map::region(DrainageCell corner) {
    std::shared_ptr<KeptRegion> found = find(corner);
    std::call_once(found->made, [&] {
        TERRANE_ZONE("drainage region");
        found->region = makeDrainageRegion(heights, corner);
        const std::lock_guard lock(mutex);
        found->bytes = found->region->bytes();
        forgetOldest();
    });
    return found;
}

namespace {

// A tile's square in units of 1/16 block from a region's corner.
struct TileSquare {
    std::int32_t x, y, width;
};

std::int32_t gap(std::int32_t first, std::int32_t last, std::int32_t low, std::int32_t high) {
    return std::max({first - high, low - last, 0});
}

struct Box {
    std::int32_t lowX, lowY, highX, highY;
};

Box boxOf(const CourseSegment& s) {
    const auto [lowX, highX] = std::minmax(s.from.x, s.to.x);
    const auto [lowY, highY] = std::minmax(s.from.y, s.to.y);
    return {lowX, lowY, highX, highY};
}

bool isNear(const TileSquare& tile, const Box& box, std::int64_t reach) {
    const std::int64_t dx = gap(tile.x, tile.x + tile.width, box.lowX, box.highX),
                       dy = gap(tile.y, tile.y + tile.width, box.lowY, box.highY);
    return dx * dx + dy * dy <= reach * reach;
}

float blocksOf(std::int32_t units) {
    return static_cast<float>(units) * (1.0f / static_cast<float>(kPlaceUnits));
}

shared::RiverSegment tileSegment(const TileSquare& tile, const CourseSegment& s) {
    const float dx = blocksOf(s.to.x - s.from.x), dy = blocksOf(s.to.y - s.from.y);
    return {{blocksOf(s.from.x - tile.x), blocksOf(s.from.y - tile.y), dx, dy},
            {s.inverse, s.from.halfWidth, s.to.halfWidth - s.from.halfWidth, s.from.level},
            {s.to.level - s.from.level, s.from.flow, s.to.flow - s.from.flow, s.fall}};
}

std::int32_t unitsOf(float reach) {
    return static_cast<std::int32_t>(reach * static_cast<float>(kPlaceUnits)) + 1;
}

void addSegments(DrainageTile& tile, const DrainageRegion& region, const CellCourses& cell,
                 const TileSquare& square, DrainageUses uses) {
    const std::int32_t riverReach = unitsOf(tile.reach), valleyReach = unitsOf(tile.valleyReach);
    const Box whole = {cell.lowX, cell.lowY, cell.highX, cell.highY};
    uses.rivers = uses.rivers && cell.hasRiver && isNear(square, whole, riverReach);
    uses.valleys = uses.valleys && isNear(square, whole, valleyReach);
    if (cell.segmentCount == 0 || (!uses.rivers && !uses.valleys)) return;
    const auto add = [&](const CourseSegment& s) {
        const bool isWet = s.from.halfWidth > 0.0f || s.to.halfWidth > 0.0f;
        const bool isRiver = uses.rivers && isWet && isNear(square, boxOf(s), riverReach);
        if (isRiver || (uses.valleys && isNear(square, boxOf(s), valleyReach)))
            tile.segments.push_back(tileSegment(square, s));
    };
    const CourseSegment* first = &region.segments[cell.firstSegment];
    if (tile.step > kMaxDrainageStep) return add(segmentOf(first->from, first[cell.segmentCount - 1].to));
    for (std::uint32_t k = 0; k < cell.segmentCount; ++k) add(first[k]);
}

void addLake(DrainageTile& tile, const DrainageRegion& region, const CellCourses& cell,
             const TileSquare& square) {
    if (cell.lake < 0 || tile.step > kMaxDrainageStep) return;
    const LakeDisc& lake = region.lakes[static_cast<std::size_t>(cell.lake)];
    tile.lakes.emplace_back(blocksOf(lake.x - square.x), blocksOf(lake.y - square.y), lake.radius,
                            lake.level);
}

}  // namespace

DrainageMaps::DrainageMaps(const std::vector<DrainageGraph>& graphs, std::uint64_t worldSeed) {
    for (const DrainageGraph& graph : graphs) maps_.push_back(std::make_unique<Map>(graph, worldSeed));
}

DrainageMaps::~DrainageMaps() = default;

// Cells are counted from the tile's own and then wrapped: the world's edge is no special case.
void DrainageMaps::prepare(DrainageTile& tile, std::uint32_t map, SampleGrid grid, DrainageUses uses) {
    Map& m = *maps_[map];
    const DrainageSpec& spec = m.heights.spec();
    tile.segments.clear();
    tile.lakes.clear();
    tile.reach = spec.reach;
    tile.valleyReach = m.heights.hasValleys() ? valleyReach(spec) : 0.0f;
    uses.valleys = uses.valleys && m.heights.hasValleys();
    const float farthest = std::max(uses.rivers ? tile.reach : 0.0f, uses.valleys ? tile.valleyReach : 0.0f);
    tile.step = grid.step;
    // With the places behind the last columns that valleys are blended from.
    const std::int32_t spacing = spec.spacing, width = kTileSize * grid.step;
    const std::int32_t around = static_cast<std::int32_t>(farthest) + 1 + spacing * kCourseReach4 / 4;
    const int shift = std::bit_width(static_cast<unsigned>(spacing)) - 1;
    const std::int32_t cellX = grid.x >> shift, cellY = grid.y >> shift;
    const std::int32_t inX = grid.x & (spacing - 1), inY = grid.y & (spacing - 1);
    std::vector<std::shared_ptr<KeptRegion>> regions;  // met so far: few
    const auto regionAt = [&](DrainageCell corner) -> const DrainageRegion& {
        for (const auto& r : regions)
            if (r->corner.x == corner.x && r->corner.y == corner.y) return *r->region;
        regions.push_back(m.region(corner));
        return *regions.back()->region;
    };
    for (std::int32_t dy = (inY - around) >> shift; dy <= (inY + width + around) >> shift; ++dy) {
        for (std::int32_t dx = (inX - around) >> shift; dx <= (inX + width + around) >> shift; ++dx) {
            const DrainageCell cell = wrapped({cellX + dx, cellY + dy}, spacing);
            const DrainageCell corner = {cell.x & -kRegionCells, cell.y & -kRegionCells};
            const DrainageRegion& region = regionAt(corner);
            const auto number =
                static_cast<std::size_t>((cell.y - corner.y) * kRegionCells + cell.x - corner.x);
            // From the region's corner to the tile, by way of the cell: both differences are small.
            const TileSquare square = {((cell.x - corner.x - dx) * spacing + inX) * kPlaceUnits,
                                       ((cell.y - corner.y - dy) * spacing + inY) * kPlaceUnits,
                                       width * kPlaceUnits};
            addSegments(tile, region, region.cells[number], square, uses);
            if (uses.rivers) addLake(tile, region, region.cells[number], square);
        }
    }
}

std::size_t DrainageMaps::cachedRegions() const {
    std::size_t sum = 0;
    for (const auto& map : maps_) {
        const std::lock_guard lock(map->mutex);
        sum += map->kept.size();
    }
    return sum;
}

std::size_t DrainageMaps::bytes() const {
    std::size_t sum = 0;
    for (const auto& map : maps_) {
        const std::lock_guard lock(map->mutex);
        for (const auto& r : map->kept) sum += r->bytes;
    }
    return sum;
}

}  // namespace terrane::gen
