#include "terrane/gen/erosion.h"

#include <fmt/format.h>

#include <numbers>

namespace terrane::gen {

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
