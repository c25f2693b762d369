#include "terrane/gen/generators/trees/branching.h"

#include <algorithm>
#include <limits>

namespace terrane::gen::trees {
namespace {

constexpr int kMaxRounds = 200;
constexpr std::size_t kMaxNodes = 4000;

struct Attractor {
    Point at;
    int nearest = -1;
    float distance = std::numeric_limits<float>::max();  // squared
};

void look(Attractor& a, const Branches& branches, std::size_t firstNew) {
    for (std::size_t n = firstNew; n < branches.size(); ++n) {
        const float distance = lengthSquared(branches[n].at - a.at);
        if (distance >= a.distance) continue;
        a.distance = distance;
        a.nearest = static_cast<int>(n);
    }
}

// The sum of unit vectors to what each node attracts; zero where nothing does.
std::vector<Point> pulls(const Branches& branches, const std::vector<Attractor>& attractors,
                         float influence) {
    std::vector<Point> sums(branches.size());
    for (const Attractor& a : attractors) {
        if (a.distance > influence * influence) continue;
        const auto n = static_cast<std::size_t>(a.nearest);
        sums[n] = sums[n] + normalized(a.at - branches[n].at);
    }
    return sums;
}

bool hasChildAt(const Branches& branches, int parent, Point at) {
    return std::any_of(branches.begin(), branches.end(), [&](const BranchNode& n) {
        return n.parent == parent && lengthSquared(n.at - at) < 0.04f;
    });
}

}  // namespace

void addLine(Branches& branches, int parent, Point from, Point to) {
    const int steps = std::max(1, static_cast<int>(lengthOf(to - from)));
    for (int k = 0; k <= steps; ++k) {
        const float t = shared::detDivide(static_cast<float>(k), static_cast<float>(steps));
        branches.push_back({from + (to - from) * t, parent});
        parent = static_cast<int>(branches.size() - 1);
    }
}

void colonize(Branches& branches, std::vector<Point> points, const GrowthRules& rules, Random& random) {
    std::vector<Attractor> attractors;
    for (const Point at : points) attractors.push_back({at});
    std::size_t firstNew = 0;
    for (int round = 0; round < kMaxRounds && branches.size() < kMaxNodes; ++round) {
        for (Attractor& a : attractors) look(a, branches, firstNew);
        std::erase_if(attractors, [&](const Attractor& a) { return a.distance < rules.kill * rules.kill; });
        firstNew = branches.size();
        const std::vector<Point> sums = pulls(branches, attractors, rules.influence);
        for (std::size_t n = 0; n < sums.size(); ++n) {
            if (lengthSquared(sums[n]) == 0.0f) continue;
            const Point toward = normalized(sums[n]) + rules.tropism + random.inBall() * rules.wobble;
            const Point at = branches[n].at + normalized(toward) * rules.step;
            if (!hasChildAt(branches, static_cast<int>(n), at)) branches.push_back({at, static_cast<int>(n)});
        }
        if (branches.size() == firstNew) return;
    }
}

void setRadii(Branches& branches, float rootRadius) {
    for (BranchNode& n : branches) n.tips = 0;
    for (std::size_t k = branches.size(); k-- > 0;) {
        if (branches[k].tips == 0) branches[k].tips = 1;
        if (branches[k].parent >= 0)
            branches[static_cast<std::size_t>(branches[k].parent)].tips += branches[k].tips;
    }
    const float scale =
        rootRadius * shared::detReciprocal(shared::detSqrt(static_cast<float>(branches.front().tips)));
    for (BranchNode& n : branches) n.radius = scale * shared::detSqrt(static_cast<float>(n.tips));
}

void drawLimbs(Canvas& canvas, const Branches& branches, Canvas::Paint wood, int minTips) {
    for (const BranchNode& n : branches) {
        if (n.parent < 0 || n.tips < minTips) continue;
        const BranchNode& parent = branches[static_cast<std::size_t>(n.parent)];
        canvas.limb(parent.at, n.at, parent.radius, n.radius, wood);
    }
}

std::vector<Point> pointsIn(const Crown& crown, int count, Random& random) {
    std::vector<Point> points;
    for (int tries = 0; tries < 20 * count && static_cast<int>(points.size()) < count; ++tries) {
        const Point p = random.inBall();
        if (lengthSquared(p) < crown.hollow * crown.hollow) continue;
        const Point at = crown.middle + Point{p.x * crown.radii.x, p.y * crown.radii.y, p.z * crown.radii.z};
        if (at.z >= crown.floor) points.push_back(at);
    }
    return points;
}

void growTrunk(Branches& branches, float height, float lean, Random& random) {
    const Point away = heading(random.unit()) * lean;
    const Point bend = heading(random.unit()) * (lean * 0.5f);
    const Point middle = away * 0.35f + bend + Point{0, 0, height * 0.5f};
    addLine(branches, -1, kRootEnd, {0, 0, 0});
    addLine(branches, static_cast<int>(branches.size() - 1), {0, 0, 1}, middle);
    addLine(branches, static_cast<int>(branches.size() - 1), middle, away + Point{0, 0, height});
}

void drawFoliage(Canvas& canvas, const Branches& branches, const Foliage& foliage, Canvas::Paint leaves,
                 Random& random) {
    for (const BranchNode& n : branches) {
        if (n.parent < 0 || n.tips > foliage.maxTips) continue;
        const float size = random.between(0.8f, 1.15f);
        canvas.clump(n.at, foliage.radii * size, foliage.edge, leaves, random);
    }
}

float turnsOf(int k, int count, float first, Random& random) {
    return first + (static_cast<float>(k) + random.between(-.25f, .25f)) *
                       shared::detReciprocal(static_cast<float>(count));
}

void drawRoots(Canvas& canvas, int count, float length, float radius, Canvas::Paint wood, Random& random) {
    const float first = random.unit();
    for (int k = 0; k < count; ++k) {
        const float turns = turnsOf(k, count, first, random);
        const Point out = heading(turns) * (length * random.between(.8f, 1.2f));
        canvas.limb({0, 0, 1.5f}, out + Point{0, 0, -2.5f}, radius, 0.5f, wood);
    }
}

}  // namespace terrane::gen::trees
