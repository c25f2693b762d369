#include "terrane/gen/drainage/drainage_curves.h"

#include <algorithm>
#include <cmath>

#include "terrane/shared/det_math.h"
#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

constexpr int kCurveSegments = 16, kDryCurveSegments = 8;
constexpr int kRegionMargin =
    88;  // cells around a region: kNetworkMargin up to a multiple of what heights come in
static_assert(kRegionMargin >= kNetworkMargin && kRegionMargin % (kTileSize / kCellSamples) == 0);

// A node beside the sea that is no higher than this above it has water at sea level: an estuary. Without it
// rivers would stand above the sea where the coast lies far from the next node.
constexpr float kEstuary = 8.0f;  // blocks

constexpr float kBlock = 1.0f / static_cast<float>(kPlaceUnits);

// A number in −1…1 that changes smoothly with the place, from random ones at the nodes of a lattice of
// `size` units of 1/16 block, a power of two.
float smoothNoise(std::uint32_t x, std::uint32_t y, std::uint32_t size, std::uint32_t seed) {
    const std::uint32_t cellX = x / size, cellY = y / size;
    const auto at = [&](std::uint32_t dx, std::uint32_t dy) {
        // As places, which wrap: the last lattice node is the first.
        const std::uint32_t h = shared::hash2((cellX + dx) * size, (cellY + dy) * size, seed);
        return static_cast<float>(h >> 8) * 0x1p-23f - 1.0f;
    };
    const auto fade = [size](std::uint32_t v) {
        const float f = static_cast<float>(v % size) / static_cast<float>(size);
        return f * f * (3.0f - 2.0f * f);
    };
    const float u = fade(x), v = fade(y);
    const float low = at(0, 0) + u * (at(1, 0) - at(0, 0)), high = at(0, 1) + u * (at(1, 1) - at(0, 1));
    return low + v * (high - low);
}

// A point of a curve before it is moved, blocks from the corner of its node's cell: the same numbers in every
// region.
struct Control {
    float x, y, halfWidth, level, flow;
};

Control dry(Control c) {
    c.halfWidth = 0.0f;
    return c;
}

Control middle(const Control& a, const Control& b) {
    return {(a.x + b.x) * 0.5f, (a.y + b.y) * 0.5f, a.halfWidth, (a.level + b.level) * 0.5f, a.flow};
}

class CurveMaker {
  public:
    CurveMaker(const DrainageHeights& heights, DrainageCell corner, int side) : spec_(heights.spec()) {
        region_.corner = corner;
        region_.side = side;
        network_.side = side + 2 * kRegionMargin;
        DrainageNodes nodes =
            heights.nodes({corner.x - kRegionMargin, corner.y - kRegionMargin}, network_.side);
        places_ = std::move(nodes.places);
        network_.heights = std::move(nodes.heights);
        network_.gradients = std::move(nodes.gradients);
        findDrainage(network_, spec_);
        bendSeed_ = heights.hash({0, 0});
    }

    DrainageRegion make() {
        for (int y = 0; y < region_.side; ++y) {
            for (int x = 0; x < region_.side; ++x) {
                CellCourses cell;
                cell.firstSegment = static_cast<std::uint32_t>(region_.segments.size());
                addCurves(x, y);
                cell.segmentCount = static_cast<std::uint32_t>(region_.segments.size()) - cell.firstSegment;
                cell.lake = addLake(x, y);
                surround(cell);
                region_.cells.push_back(cell);
            }
        }
        return std::move(region_);
    }

  private:
    void surround(CellCourses& cell) const {
        for (std::uint32_t k = 0; k < cell.segmentCount; ++k) {
            const auto& [from, to, inverse, fall] = region_.segments[cell.firstSegment + k];
            if (k == 0) {
                cell.lowX = cell.highX = from.x;
                cell.lowY = cell.highY = from.y;
            }
            cell.lowX = std::min({cell.lowX, from.x, to.x});
            cell.lowY = std::min({cell.lowY, from.y, to.y});
            cell.highX = std::max({cell.highX, from.x, to.x});
            cell.highY = std::max({cell.highY, from.y, to.y});
            cell.hasRiver = cell.hasRiver || from.halfWidth > 0.0f || to.halfWidth > 0.0f;
        }
    }

    std::size_t at(int x, int y) const { return network_.at(x + kRegionMargin, y + kRegionMargin); }
    bool isSea(std::size_t node) const { return network_.heights[node] < heightKey(spec_.seaLevel, 0); }
    bool isRiver(std::size_t node) const { return network_.flows[node] >= spec_.minFlow; }
    bool isStream(std::size_t node) const { return !isSea(node) && (hasValleys() || isRiver(node)); }
    bool hasValleys() const { return !network_.gradients.empty(); }

    struct Place {
        float x, y;
    };

    Place place(int x, int y) const {
        const auto spacing = static_cast<float>(spec_.spacing);
        const NodePlace p = places_[at(cellX_ + x, cellY_ + y)];
        return {static_cast<float>(x) * spacing + static_cast<float>(p.x) * kBlock,
                static_cast<float>(y) * spacing + static_cast<float>(p.y) * kBlock};
    }

    // Moves a node half way to the middle between the nodes before and after it, which rounds corners.
    Place smoothPlace(int x, int y) const {
        const Place here = place(x, y);
        const std::size_t node = at(cellX_ + x, cellY_ + y);
        if (network_.drains[node] == kNoDrain) return here;
        int before = kNoDrain, flow = hasValleys() ? 0 : spec_.minFlow - 1;
        for (int k = 0; k < kNoDrain; ++k) {
            const auto& [dx, dy] = kDirections[static_cast<std::size_t>(k)];
            const std::size_t other = at(cellX_ + x + dx, cellY_ + y + dy);
            if (!drainsTo(other, node) || network_.flows[other] <= flow) continue;
            before = k;
            flow = network_.flows[other];
        }
        if (before == kNoDrain) return here;
        const auto& [inX, inY] = kDirections[static_cast<std::size_t>(before)];
        const auto& [outX, outY] = kDirections[network_.drains[node]];
        const Place in = place(x + inX, y + inY), out = place(x + outX, y + outY);
        return {here.x * 0.5f + (in.x + out.x) * 0.25f, here.y * 0.5f + (in.y + out.y) * 0.25f};
    }

    bool drainsTo(std::size_t node, std::size_t to) const {
        return network_.drains[node] != kNoDrain && network_.drainOf(node) == to;
    }

    // Control point of the node at an offset from the current cell.
    Control control(int x, int y) const {
        const std::size_t node = at(cellX_ + x, cellY_ + y);
        const Place place = smoothPlace(x, y);
        const auto flow = static_cast<float>(network_.flows[node]);
        const float share = flow / static_cast<float>(spec_.minFlow);
        const float halfWidth = std::min(spec_.halfWidth * shared::detSqrt(share), spec_.maxHalfWidth);
        return {place.x, place.y, isRiver(node) ? halfWidth : 0.0f, levelOf(node), flow};
    }

    float levelOf(std::size_t node) const {
        const bool isMouth = network_.drains[node] != kNoDrain && isSea(network_.drainOf(node));
        return std::max(heightOf(network_.levels[node]) - (isMouth ? kEstuary : 0.0f), spec_.seaLevel);
    }

    void addCurves(int x, int y) {
        cellX_ = x;
        cellY_ = y;
        const std::size_t node = at(x, y);
        const bool isEnd = network_.drains[node] == kNoDrain;
        if (!isEnd && !isStream(node)) return;
        const Control here = control(0, 0);
        lake_ = {here.x, here.y, lakeRadius(node), here.level};
        Control out = here;
        if (!isEnd) {
            const auto& [dx, dy] = kDirections[network_.drains[node]];
            out = middle(here, control(dx, dy));
        }
        bool isSource = true, hasRiver = false;
        for (const auto& [dx, dy] : kDirections) {
            const std::size_t other = at(x + dx, y + dy);
            hasRiver |= isStream(other) && isRiver(other) && drainsTo(other, node);
        }
        for (const auto& [dx, dy] : kDirections) {
            const std::size_t other = at(x + dx, y + dy);
            if (!isStream(other) || !drainsTo(other, node)) continue;
            isSource = false;
            const Control in = middle(control(dx, dy), here);
            if (!isEnd) {
                // Beside a river, a dry stream stays dry.
                const bool staysDry = hasRiver && !isRiver(other);
                addCurve(in, here, staysDry ? dry(out) : out);
                continue;
            }
            Control last = here;
            last.halfWidth = in.halfWidth;
            last.flow = in.flow;
            addCurve(in, middle(in, last), last);
        }
        if (!isSource || isEnd) return;
        Control spring = here;
        spring.halfWidth = here.halfWidth * 0.25f;
        addCurve(spring, middle(here, out), out);
    }

    void addCurve(const Control& a, const Control& b, const Control& c) {
        CoursePoint from = point(a);
        const int pieces = a.halfWidth > 0.0f || c.halfWidth > 0.0f ? kCurveSegments : kDryCurveSegments;
        for (int k = 1; k <= pieces; ++k) {
            const float t = static_cast<float>(k * (kCurveSegments / pieces)) * (1.0f / kCurveSegments),
                        s = 1.0f - t;
            const auto blend = [&](float p, float q, float r) {
                return s * s * p + 2.0f * s * t * q + t * t * r;
            };
            Control at = {blend(a.x, b.x, c.x), blend(a.y, b.y, c.y), s * a.halfWidth + t * c.halfWidth,
                          blend(a.level, b.level, c.level), s * a.flow + t * c.flow};
            if (lake_.radius > 0.0f && k < pieces) at.level = levelNearLake(at, t < 0.5f ? a : c, a, c);
            at.level = std::min(at.level, from.level);
            const CoursePoint to = point(at);
            if (to.x != from.x || to.y != from.y) region_.segments.push_back(segmentOf(from, to));
            from = to;
        }
    }

    // The lake's level as far as its shore, then evenly to that at the curve's end, so that water meets
    // without falls. `end` is the one on this side of the lake, unless the course begins or ends in its
    // middle.
    float levelNearLake(const Control& at, Control end, const Control& first, const Control& last) const {
        if (fromLake(first) == 0.0f) end = last;
        if (fromLake(last) == 0.0f) end = first;
        const float whole = fromLake(end), shore = std::min(lake_.radius, whole * 0.8f);
        const float beyond = shared::detDivide(fromLake(at) - shore, whole - shore);
        return lake_.level + std::clamp(beyond, 0.0f, 1.0f) * (end.level - lake_.level);
    }

    float fromLake(const Control& c) const {
        const float dx = c.x - lake_.x, dy = c.y - lake_.y;
        return shared::detSqrt(dx * dx + dy * dy);
    }

    // 0 where there is no lake.
    float lakeRadius(std::size_t node) const {
        const int covered = network_.lakeNodes[node];
        if (covered == 0) return 0.0f;
        return std::min(0.22f + 0.03f * static_cast<float>(covered), 0.5f) *
               static_cast<float>(spec_.spacing);
    }

    CoursePoint point(const Control& c) const {
        const auto unitsOf = [](float blocks) {
            return static_cast<std::int32_t>(std::floor(blocks * static_cast<float>(kPlaceUnits)));
        };
        const auto spacing = static_cast<std::uint32_t>(spec_.spacing);
        const std::int32_t x = cellX_ * spec_.spacing * kPlaceUnits + unitsOf(c.x);
        const std::int32_t y = cellY_ * spec_.spacing * kPlaceUnits + unitsOf(c.y);
        // Moved by a noise of its place in the world, so that curves that meet stay together.
        const std::uint32_t cornerX = static_cast<std::uint32_t>(region_.corner.x) * spacing * kPlaceUnits;
        const std::uint32_t cornerY = static_cast<std::uint32_t>(region_.corner.y) * spacing * kPlaceUnits;
        const std::uint32_t worldX = cornerX + static_cast<std::uint32_t>(x),
                            worldY = cornerY + static_cast<std::uint32_t>(y);
        const float reach = spec_.bend * static_cast<float>(spec_.spacing);
        const auto bend = [&](std::uint32_t seed) {
            const float wide = smoothNoise(worldX, worldY, spacing * kPlaceUnits, bendSeed_ + seed);
            const float narrow = smoothNoise(worldX, worldY, spacing * kPlaceUnits / 2, bendSeed_ + seed + 1);
            // Less than a block a block at the largest bend, 0.25 · (0.7 · 3 + 0.3 · 6): courses do not fold.
            return unitsOf(reach * (wide * 0.7f + narrow * 0.3f));
        };
        return {x + bend(1), y + bend(3), c.halfWidth, c.level, c.flow};
    }

    std::int32_t addLake(int x, int y) {
        const float radius = lakeRadius(at(x, y));
        if (radius == 0.0f) return -1;
        cellX_ = x;
        cellY_ = y;
        const Control here = control(0, 0);
        const CoursePoint place = point(here);
        region_.lakes.push_back({place.x, place.y, radius, here.level});
        return static_cast<std::int32_t>(region_.lakes.size()) - 1;
    }

    const DrainageSpec& spec_;
    std::vector<NodePlace> places_;
    DrainageNetwork network_;
    std::uint32_t bendSeed_ = 0;
    // The cell whose curves are made, and its lake.
    int cellX_ = 0, cellY_ = 0;
    struct {
        float x, y, radius, level;
    } lake_{};
    DrainageRegion region_;
};

}  // namespace

CourseSegment segmentOf(const CoursePoint& from, const CoursePoint& to) {
    const float dx = static_cast<float>(to.x - from.x) * kBlock,
                dy = static_cast<float>(to.y - from.y) * kBlock;
    const float inverse = shared::detDivide(1.0f, dx * dx + dy * dy);
    return {from, to, inverse, (from.level - to.level) * shared::detSqrt(inverse)};
}

std::size_t DrainageRegion::bytes() const {
    return sizeof(*this) + segments.capacity() * sizeof(CourseSegment) + lakes.capacity() * sizeof(LakeDisc) +
           cells.capacity() * sizeof(CellCourses);
}

DrainageRegion makeDrainageRegion(const DrainageHeights& heights, DrainageCell corner, int side) {
    return CurveMaker(heights, corner, side).make();
}

}  // namespace terrane::gen
