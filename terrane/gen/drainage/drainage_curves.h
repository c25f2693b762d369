// The courses of rivers and the lakes of one region of a map, as short straight segments sorted by cell.
//
// Corners of the way from node to node are rounded, then through each river node runs a quadratic Bézier
// curve for each river that comes to it: from the middle of the way to it, with the node as control point, to
// the middle of the way on. All curves of a node end in one point with one direction, so that confluences are
// smooth. Levels follow the same curve of the nodes' levels, half widths and flows change evenly. Then every
// point is moved by a noise of two octaves, which makes bends. All functions are pure; any thread may call
// them.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/gen/drainage/drainage_heights.h"

namespace terrane::gen {

// Cells of the regions that maps keep, along x and along y. A region reads kNetworkMargin cells around it: of
// these, small ones read more for each cell of their own, and large ones make more that no view sees. The
// heights of cells are shared by the regions (drainage_heights.h).
constexpr int kRegionCells = 32;

// A point of a river's course.
struct CoursePoint {
    std::int32_t x, y;  // 1/16 blocks from the region's corner
    float halfWidth, level, flow;
};

struct CourseSegment {
    CoursePoint from, to;  // downstream
    float inverse, fall;   // 1 / length², fall of the level a block; of segmentOf()
};
CourseSegment segmentOf(const CoursePoint& from, const CoursePoint& to);

struct LakeDisc {
    std::int32_t x, y;  // 1/16 blocks from the region's corner
    float radius, level;
};

// A cell's courses are the curves of its node, which is moved by half a cell at most towards its neighbors.
// They end half way to the next nodes and are bent by a quarter: they lie within 5/4 of a cell around it.
constexpr int kCourseReach4 = 5;  // quarters of the spacing

struct CellCourses {
    std::uint32_t firstSegment = 0, segmentCount = 0;
    std::int32_t lake = -1;
    // Around all segments: 1/16 blocks from the region's corner.
    std::int32_t lowX = 0, lowY = 0, highX = 0, highY = 0;
    bool hasRiver = false;  // some segment is not dry
};

struct DrainageRegion {
    DrainageCell corner;
    int side = 0;  // cells
    std::vector<CourseSegment> segments;
    std::vector<LakeDisc> lakes;
    std::vector<CellCourses> cells;  // side² by y, then x

    std::size_t bytes() const;
};

// Returns the region of side² cells whose first is `corner`; both are multiples of 8. Takes milliseconds.
DrainageRegion makeDrainageRegion(const DrainageHeights& heights, DrainageCell corner,
                                  int side = kRegionCells);

}  // namespace terrane::gen
