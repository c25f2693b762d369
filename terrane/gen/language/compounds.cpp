#include "terrane/gen/language/compounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

namespace terrane::gen {

namespace {

constexpr int kMaxSquares = 4;  // along each axis of a column

struct ScatterSize {
    std::string name;
    int spacing, jitter;  // blocks; points lie in 0…jitter−1 of their square
};

// The point of the square in which a block lies.
IVec2 pointOf(Pass& p, const ScatterSize& size, Int blockX, Int blockY) {
    const Float spacing(static_cast<float>(size.spacing)), jitter(static_cast<float>(size.jitter));
    const Int row = floorDivide(blockY, size.spacing);
    // Any shift of a whole row keeps its distance from other rows, which y alone has.
    const Int shift(p.random2D(size.name + " row", row, 0) * spacing);
    const Int column = floorDivide(blockX - shift, size.spacing);
    const Int dx(p.random2D(size.name + " x", column, row) * jitter);
    const Int dy(p.random2D(size.name + " y", column, row) * jitter);
    return {column * size.spacing + shift + dx, row * size.spacing + dy};
}

}  // namespace

ScatterPoint scatter(Pass& p, std::string_view name, int spacing, int minDistance) {
    spacing = std::clamp(spacing, 1, kMaxScatterSpacing);
    const ScatterSize size = {"scatter " + std::string(name), spacing,
                              spacing - std::clamp(minDistance, 1, spacing) + 1};
    const int step = p.step();
    const Int left = p.x() - step / 2, bottom = p.y() - step / 2;  // the column's first block
    // A wide column meets several squares; of very many the first ones do.
    const int reach = std::min((step - 1 + spacing - 1) / spacing, kMaxSquares - 1);
    ScatterPoint found = {false, {p.x(), p.y()}, 0};
    for (int k = (reach + 1) * (reach + 1); k-- > 0;) {
        const Int inX = left + std::min(k % (reach + 1) * spacing, step - 1);
        const Int inY = bottom + std::min(k / (reach + 1) * spacing, step - 1);
        const IVec2 at = pointOf(p, size, inX, inY);
        // Differences, since at the world's edge positions wrap.
        const Int dx = at.x - left, dy = at.y - bottom;
        const Bool isHere = dx >= 0 && dx < step && dy >= 0 && dy < step;
        found.isHere = found.isHere || isHere;
        found.at = {select(isHere, at.x, found.at.x), select(isHere, at.y, found.at.y)};
    }
    found.hash = Int(p.random2D(size.name, found.at.x, found.at.y) * 16777216.0f);
    return found;
}

Eroded erode(Pass& p, std::string_view name, Vec2 slope, Float strength, const Erosion& erosion) {
    constexpr float kMinSlope = 1e-4f;  // below it no direction is downhill
    constexpr float kRidgeOctaves = 2;  // those that are seen from afar
    Eroded result = {0.0f, 0.0f};
    Float most = 1.0f;
    float depth = erosion.depth * static_cast<float>(erosion.size), ridgeShare = 0.65f;
    for (int octave = 0; octave < erosion.octaves; ++octave) {
        const int size = erosion.size >> octave;
        const Float steepness = length(slope);
        // Gullies do not grow on the sides of others alone: where the ground was flat it stays flat.
        most = min(steepness * (1.0f / erosion.fullSlope), most);
        const Float whole = most * (2.0f - most) * strength * depth;  // blocks from ridge to gully
        result.height = result.height - whole * 0.5f;
        const float left = shareLeft(size, p.step());
        if (left > 0.0f) {
            const Float inverse = 1.0f / max(steepness, Float(kMinSlope));
            const Vec2 across = {-slope.y * inverse, slope.x * inverse};
            const Stripes2D wave = p.stripes2D(fmt::format("{} {}", name, octave), size, across);
            const Float half = whole * (0.5f * left);
            result.height = result.height + wave.cosine * half;
            if (static_cast<float>(octave) < kRidgeOctaves)
                result.ridge = result.ridge + wave.cosine * ridgeShare * left;
            // The cosine falls with the sine of its phase, 2π a size.
            const Float turned =
                wave.sine * half * (-2.0f * std::numbers::pi_v<float> / static_cast<float>(size));
            slope = slope + across * turned;
        }
        ridgeShare = 0.35f;
        depth *= erosion.gain;
    }
    return result;
}

}  // namespace terrane::gen
