// Branches by space colonization: A. Runions, B. Lane, P. Prusinkiewicz, Modeling Trees with a Space
// Colonization Algorithm, 2007. Points in the space of the crown attract the nearest branch, which grows
// toward their mean direction; a branch that comes near takes a point away. So branches divide the space
// among each other, and the crown has the form of the points.
#pragma once

#include <vector>

#include "terrane/gen/generators/trees/canvas.h"

namespace terrane::gen::trees {

struct BranchNode {
    Point at;
    int parent = -1;
    int tips = 0;  // ends of branches beyond it, itself if it is one
    float radius = 0;
};

// Parents before their children.
using Branches = std::vector<BranchNode>;

struct GrowthRules {
    float influence = 8;        // blocks: points farther from every branch attract nothing
    float kill = 2;             // blocks
    float step = 1;             // blocks from node to node
    Point tropism = {0, 0, 0};  // added to the direction: upward for light, downward for weight
    float wobble = 0.2f;        // by chance, added to the direction
};

// Adds a straight line of nodes, for trunks. `parent` is as in BranchNode.
void addLine(Branches& branches, int parent, Point from, Point to);
// Grows from all existing nodes.
void colonize(Branches& branches, std::vector<Point> points, const GrowthRules& rules, Random& random);
// Counts tips; the cross-section of a branch is that of all its tips together (Leonardo's rule), scaled so
// that the root has rootRadius.
void setRadii(Branches& branches, float rootRadius);
// Draws the branches. Branches with fewer tips than `minTips` are omitted: they are twigs that leaves hide.
void drawLimbs(Canvas& canvas, const Branches& branches, Canvas::Paint wood, int minTips = 1);

// Points in an ellipsoid, at least `hollow` (0…1) of its radius from the middle, not below z = `floor`.
struct Crown {
    Point middle, radii;
    float hollow = 0;
    float floor = 0;
};
std::vector<Point> pointsIn(const Crown& crown, int count, Random& random);

// Trunks continue below their foot, so that they stand on slopes.
constexpr Point kRootEnd = {0, 0, -2};

// Adds a trunk that leans and bends a little.
void growTrunk(Branches& branches, float height, float lean, Random& random);

struct Foliage {
    Point radii;       // of the clump at each end of a branch
    float edge = .4f;  // how much of its outermost voxels stays
    int maxTips = 1;   // clumps stand on branches with at most so many ends
};
void drawFoliage(Canvas& canvas, const Branches& branches, const Foliage& foliage, Canvas::Paint leaves,
                 Random& random);

// Returns the direction, in turns, of the k-th of `count` things around a trunk, each moved by up to a
// quarter of the distance to the next.
float turnsOf(int k, int count, float first, Random& random);

// Draws roots that run out from the foot into the earth.
void drawRoots(Canvas& canvas, int count, float length, float radius, Canvas::Paint wood, Random& random);

}  // namespace terrane::gen::trees
