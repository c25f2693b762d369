#include "terrane/render/land_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "terrane/base/require.h"

namespace terrane::render {
namespace {

// Shadows of a light at the horizon would be endless.
constexpr float kMinSlope = 0.01f;
constexpr float kOverhead = 1e-3f;  // a light straight above casts none

// Order of a sweep over the square: line by line away from the light.
struct Walk {
    bool isAlongX;    // a line is a column
    int first, step;  // lines
    float sideways;   // texels along a line from a texel to its q, -1…1
};

Walk walkFrom(glm::vec3 direction, int side) {
    Walk walk{};
    walk.isAlongX = std::abs(direction.x) >= std::abs(direction.y);
    const float major = walk.isAlongX ? direction.x : direction.y;
    const float minor = walk.isAlongX ? direction.y : direction.x;
    walk.first = major > 0 ? side - 1 : 0;
    walk.step = major > 0 ? -1 : 1;
    walk.sideways = minor / std::abs(major);
    return walk;
}

// The higher of a texel's land and its shadow, with one more texel at both ends: texel k of the line is at k
// + 1.
struct Line {
    std::vector<float> top, distance;
};

void setFromOutside(Line& line, std::size_t at, const LandShadow& shadow) {
    line.top[at] = shadow.height;
    line.distance[at] = shadow.distance;
}

}  // namespace

void sweepShadows(const LandHeights& land, glm::vec3 direction,
                  const std::function<LandShadow(glm::vec2)>& outside, std::span<LandShadow> shadows) {
    const auto side = static_cast<std::size_t>(land.side);
    base::require(land.blocks.size() == side * side && shadows.size() == land.blocks.size(),
                  "sweepShadows: heights and shadows are squares of one size");
    const float across = std::hypot(direction.x, direction.y);
    if (across < kOverhead) {
        std::ranges::fill(shadows, LandShadow{kNoShadow, 0});
        return;
    }
    const Walk walk = walkFrom(direction, land.side);
    const float stride = land.texelBlocks * std::hypot(1.0f, walk.sideways);
    const float drop = stride * std::max(direction.z / across, kMinSlope);
    const std::size_t shift = walk.sideways < 0 ? 0 : 1;  // of q's first texel
    const float share = walk.sideways - std::floor(walk.sideways) + (walk.sideways == 1.0f ? 1.0f : 0.0f);
    const auto texel = [&](int line, std::size_t k) {
        const auto l = static_cast<std::size_t>(line);
        return walk.isAlongX ? k * side + l : l * side + k;
    };
    const auto outsideAt = [&](int line, int k) {
        const glm::vec2 place(line, k);
        return outside(walk.isAlongX ? place : glm::vec2(place.y, place.x));
    };

    Line before{std::vector<float>(side + 2), std::vector<float>(side + 2)}, now = before;
    for (int k = -1; k <= land.side; ++k)
        setFromOutside(before, static_cast<std::size_t>(k + 1), outsideAt(walk.first - walk.step, k));
    for (int n = 0; n < land.side; ++n) {
        const int line = walk.first + n * walk.step;
        for (std::size_t k = 0; k < side; ++k) {
            const std::size_t q = k + shift;
            const float height = before.top[q] + share * (before.top[q + 1] - before.top[q]) - drop;
            const float distance =
                before.distance[q] + share * (before.distance[q + 1] - before.distance[q]) + stride;
            const float here = land.blocks[texel(line, k)];
            shadows[texel(line, k)] = {height, distance};
            now.top[k + 1] = std::max(here, height);
            now.distance[k + 1] = here >= height ? 0.0f : distance;
        }
        setFromOutside(now, 0, outsideAt(line, -1));
        setFromOutside(now, side + 1, outsideAt(line, land.side));
        std::swap(before, now);
    }
}

namespace {

// Raises the tangents of the horizon to that of the land `away` (texels).
void raiseHorizon(const LandHeights& land, glm::ivec2 away, std::span<float> tangents) {
    const float scale =
        1.0f / (land.texelBlocks * std::hypot(static_cast<float>(away.x), static_cast<float>(away.y)));
    const int firstX = std::max(0, -away.x), endX = std::min(land.side, land.side - away.x);
    const int firstY = std::max(0, -away.y), endY = std::min(land.side, land.side - away.y);
    const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(away.y) * land.side + away.x;
    for (int y = firstY; y < endY; ++y) {
        const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y) * land.side;
        const float* from = land.blocks.data() + row;
        float* to = tangents.data() + row;
        for (int x = firstX; x < endX; ++x) to[x] = std::max(to[x], (from[x + offset] - from[x]) * scale);
    }
}

constexpr int kDirections = 8;
constexpr int kDistances = 6;  // each twice the one before

}  // namespace

void skyVisibility(const LandHeights& land, float minBlocks, std::span<float> visibility) {
    base::require(visibility.size() == land.blocks.size(), "skyVisibility: each texel needs a value");
    std::ranges::fill(visibility, 1.0f);
    std::vector<float> tangents(visibility.size());
    for (int k = 0; k < kDirections; ++k) {
        const float angle = 2 * 3.14159265f * static_cast<float>(k) / kDirections;
        std::ranges::fill(tangents, 0.0f);
        for (int n = 0; n < kDistances; ++n) {
            const float texels = std::ldexp(minBlocks, n) / land.texelBlocks;
            const float used = n == 0 ? std::max(texels, 1.0f) : texels;
            if (used < 1.0f || used > static_cast<float>(land.side) / 4) continue;
            const glm::ivec2 away(std::lround(used * std::cos(angle)), std::lround(used * std::sin(angle)));
            raiseHorizon(land, away, tangents);
        }
        for (std::size_t p = 0; p < tangents.size(); ++p) {
            const float square = tangents[p] * tangents[p];
            visibility[p] -= square / (1 + square) / kDirections;
        }
    }
}

}  // namespace terrane::render
