#include "bench/hole_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "terrane/shared/ray_step.h"
#include "terrane/view/path_scene.h"
#include "terrane/world/sky/environment.h"

namespace terrane::bench {
namespace {

using world::ChunkPos;

// Images of depth have 8 bits: near ground needs finer steps than far ground.
constexpr std::array<float, 3> kFogDistances = {128, 2048, 32768};
constexpr double kMostBlocks = 30'000;
// Blocks that are equal, beside a share of the distance: quads are moved by less.
constexpr double kTolerance = 0.75, kRelativeTolerance = 0.01;

// Of some rays.
struct Range {
    double nearest = kNothing, nearestClosed = kNothing, farthest = 0;

    void add(const RayEnd& end) {
        nearest = std::min(nearest, end.ground);
        nearestClosed = std::min(nearestClosed, end.closed);
        farthest = std::max(farthest, end.ground);
    }
};

double tolerance(double distance) {
    return kTolerance + kRelativeTolerance * distance;
}
bool isBehind(const Interval& drawn, double distance) {
    return drawn.low > distance + tolerance(distance);
}
bool isBefore(const Interval& drawn, double distance) {
    return drawn.high < distance - tolerance(distance);
}
bool agrees(const Interval& drawn, const Range& range) {
    return !isBehind(drawn, range.farthest) && !isBefore(drawn, range.nearest);
}

bool isOpaque(const world::BlockRegistry& blocks, world::BlockId id) {
    return id != world::kAir && blocks.type(id).opaqueCube;
}

}  // namespace

std::vector<Interval> drawnDistances(render::Renderer& renderer, const render::Camera& camera,
                                     std::span<const float> fogDistances) {
    std::vector<Interval> distances;
    for (const float fog : fogDistances) {
        renderer.draw({camera, world::environmentAt(0.5f), fog, 0, render::View::Depth});
        const base::Image image = renderer.readImage();
        distances.resize(image.rgba.size() / 4);
        for (std::size_t k = 0; k < distances.size(); ++k) {
            const int value = image.rgba[4 * k];
            if (value == 0 || distances[k].low != kNothing) continue;
            distances[k] = {fog * (254.5 - value) / 255, fog * (255.5 - value) / 255};
        }
    }
    return distances;
}

PixelRays::PixelRays(const render::Camera& camera, glm::ivec2 size)
    : look_(render::lookDirection(camera)),
      right_(render::rightDirection(camera)),
      up_(glm::cross(right_, look_)),
      size_(size),
      scale_(std::tan(glm::radians(double{camera.fieldOfView}) / 2) * 2 / size.y) {}

glm::dvec3 PixelRays::at(double x, double y) const {
    return glm::normalize(look_ + right_ * (scale_ * (x + 0.5 - size_.x / 2)) +
                          up_ * (scale_ * (size_.y / 2 - y - 0.5)));
}

const world::Chunk& ShownBlocks::whole(ChunkPos pos) {
    const auto found = whole_.find(pos);
    if (found != whole_.end()) return found->second;
    return whole_.emplace(pos, view::wholeChunk(session_, pos)).first->second;
}

ShownBlocks::Area ShownBlocks::areaAt(int x, int y) {
    const auto& records = session_.tiles().table().records;
    ChunkPos pos{x >> 4, y >> 4};
    for (;; pos = stream::parentOf(pos)) {
        const auto found = records.find(pos);
        if (found != records.end() && found->second.isShown) break;
        if (pos.level == world::kMaxLevel) return {};
    }
    Area area{pos, &whole(pos)};
    if (pos.level > 0) return area;
    if (const world::ChunkPtr made = session_.world().maybeChunkAt(pos)) area.lowestMade = made->lowestMade();
    return area;
}

// Caves end before tiles (stream::closeCaves): the distance of the last layer of blocks of a chunk that the
// ray leaves at `distance`, if it is dark there.
double ShownBlocks::closedCave(const glm::dvec3& origin, const glm::dvec3& direction, double distance) const {
    constexpr double kInside = 1e-3;  // blocks
    const glm::dvec3 leaving = origin + direction * (distance - kInside);
    double layer = distance;
    for (int axis = 0; axis < 2; ++axis) {
        const double within = leaving[axis] - std::floor(leaving[axis] / 16) * 16;
        const double beyond = direction[axis] > 0 ? 16 - within : within;
        if (beyond < 2 * kInside) layer = std::min(layer, distance - 1 / std::abs(direction[axis]));
    }
    const glm::ivec3 last(glm::floor(origin + direction * std::max(layer + kInside, 0.0)));
    const std::optional<light::LightValue> light = session_.pipeline().lightAt({last.x, last.y, last.z});
    return light && light::levelOf(*light, light::kDaylight) == 0 ? layer : kNothing;
}

RayEnd ShownBlocks::cast(const glm::dvec3& origin, const glm::dvec3& direction, double mostBlocks) {
    const world::Heights heights = session_.world().heights();
    const glm::dvec3 corner = glm::floor(origin);
    const shared::Ray ray = shared::makeRay(glm::ivec4(corner, 0), glm::vec4(origin - corner, 0),
                                            glm::vec4(direction, 0), static_cast<float>(mostBlocks));
    RayEnd end{kNothing, kNothing};
    Area area;
    glm::ivec2 areaCorner(0);
    int areaShift = -1;  // its width is 2^areaShift blocks
    // A box of equal blocks after the other: a block, or a section that is all air.
    for (shared::RayPlace place = shared::rayBegin(ray); place.t < ray.start.w;) {
        const glm::ivec3 at = place.cell ^ ray.mirror;
        if (ray.mirror.z != 0 ? at.z < heights.bottom : at.z >= heights.top) break;
        if (areaShift < 0 || glm::ivec2(at) >> areaShift != areaCorner) {
            const Area before = std::exchange(area, areaAt(at.x, at.y));
            if (before.whole && before.pos.level == 0 && area.whole && area.pos.level > 0)
                end.closed = std::min(end.closed, closedCave(origin, direction, place.t));
            areaShift = 4 + (area.whole ? area.pos.level : 0);
            areaCorner = glm::ivec2(at) >> areaShift;
        }
        const int column = areaShift - 4;
        int shift = 4;  // of the box
        if (area.whole && heights.contains(at.z)) {
            const world::Section& section = area.whole->section(at.z >> 4);
            const double distance = place.t;
            if (at.z >> 4 < area.lowestMade) end.closed = std::min(end.closed, distance);
            if (!section.isUniform() || isOpaque(session_.blocks(), section.uniformValue())) {
                const world::BlockId id =
                    area.whole->block(world::blockIndex(at.x >> column & 15, at.y >> column & 15, at.z));
                if (isOpaque(session_.blocks(), id)) {
                    end.ground = distance;
                    end.closed = std::min(end.closed, distance);
                    return end;
                }
                shift = 0;
            }
        }
        shared::rayLeaveBox(ray, place, shared::rayBoxEnd(place.cell, column + shift, shift));
    }
    return end;
}

render::Camera randomCamera(const world::Chunk& chunk, ChunkPos pos, const world::BlockRegistry& blocks,
                            std::mt19937& random) {
    const auto within = [&](double least, double most) {
        return std::uniform_real_distribution<double>(least, most)(random);
    };
    const auto isOpen = [&](int x, int y, int z) {
        if (!chunk.heights().contains(z)) return z >= chunk.heights().top;
        return !isOpaque(blocks, chunk.block(world::blockIndex(x, y, z)));
    };
    const int x = static_cast<int>(within(1, 15)), y = static_cast<int>(within(1, 15));
    std::vector<int> grounds, caves;  // the lowest layers of air, all layers of caves
    int surface = chunk.heights().bottom;
    for (int z = chunk.heights().bottom + 1; z < chunk.heights().top; ++z) {
        if (isOpen(x, y, z) && !isOpen(x, y, z - 1)) grounds.push_back(z);
        if (!isOpen(x, y, z)) surface = z + 1;
    }
    for (int z = chunk.heights().bottom; z < surface; ++z)
        if (isOpen(x, y, z)) caves.push_back(z);
    const auto oneOf = [&](const std::vector<int>& layers) {
        return layers[static_cast<std::size_t>(within(0, static_cast<double>(layers.size()) - 0.01))];
    };
    const double kind = within(0, 1);
    int z = surface + static_cast<int>(within(0, 300));
    if (kind < 0.3 && !caves.empty())
        z = oneOf(caves);
    else if (kind < 0.5 && !grounds.empty())
        z = oneOf(grounds) + 1;
    else if (kind < 0.7)
        z = surface + 1;
    else if (kind < 0.8)
        z = static_cast<int>(within(surface, chunk.heights().top + 200));
    if (!isOpen(x, y, z)) z = surface + 1;
    // One in six looks straight down or up.
    const double straight = within(0, 12);
    const float pitch = straight < 1 ? 90 : straight < 2 ? -90 : static_cast<float>(within(-80, 40));
    return {{pos.x * 16 + x + 0.5, pos.y * 16 + y + 0.5, z + 0.5}, static_cast<float>(within(0, 360)), pitch};
}

HoleCount& HoleCount::operator+=(const HoleCount& other) {
    pixels += other.pixels;
    holes += other.holes;
    walls += other.walls;
    closed += other.closed;
    where.insert(where.end(), other.where.begin(), other.where.end());
    return *this;
}

HoleCount findHoles(render::Renderer& renderer, ShownBlocks& blocks, const render::Camera& camera) {
    const glm::ivec2 size = renderer.size();
    const std::vector<Interval> drawn = drawnDistances(renderer, camera, kFogDistances);
    const PixelRays rays(camera, size);
    // With a ring of pixels around the image.
    const glm::ivec2 wide = size + 2;
    std::vector<RayEnd> ends(static_cast<std::size_t>(wide.x * wide.y));
    for (int y = 0; y < wide.y; ++y) {
        for (int x = 0; x < wide.x; ++x) {
            ends[static_cast<std::size_t>(x + y * wide.x)] =
                blocks.cast(camera.position, rays.at(x - 1, y - 1), kMostBlocks);
        }
    }
    const auto near = [&](int x, int y) {
        Range range;
        for (int k = 0; k < 9; ++k)
            range.add(ends[static_cast<std::size_t>(x + k % 3 + (y + k / 3) * wide.x)]);
        return range;
    };
    // Finds what is narrower than a pixel.
    const auto nearInDetail = [&](int x, int y) {
        constexpr int kSteps = 6;  // a pixel
        Range range;
        for (int dy = -kSteps; dy <= kSteps; ++dy)
            for (int dx = -kSteps; dx <= kSteps; ++dx)
                range.add(blocks.cast(
                    camera.position, rays.at(x + dx / double{kSteps}, y + dy / double{kSteps}), kMostBlocks));
        return range;
    };
    HoleCount count;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const Interval& at = drawn[static_cast<std::size_t>(x + y * size.x)];
            const double ground = ends[static_cast<std::size_t>(x + 1 + (y + 1) * wide.x)].ground;
            count.pixels += ground != kNothing;
            const auto isClosed = [&](const Range& range) {
                return !isBehind(at, range.farthest) && !isBefore(at, range.nearestClosed);
            };
            Range range = near(x, y);
            if (agrees(at, range)) continue;
            if (!isClosed(range)) range = nearInDetail(x, y);
            if (agrees(at, range)) continue;
            const bool isHole = isBehind(at, range.farthest);
            count.holes += isHole;
            count.closed += isClosed(range);
            count.walls += !isHole && !isClosed(range);
            if (!isClosed(range))
                count.where.push_back({{x, y}, at.low, ground, camera.position + rays.at(x, y) * ground});
        }
    }
    return count;
}

}  // namespace terrane::bench
