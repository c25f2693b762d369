// Random numbers that stand for what columns of higher levels are too wide to show.
#include "terrane/gen/builder.h"
#include "terrane/gen/pass.h"

namespace terrane::gen {
namespace {

// The sum of two bytes of a hash, whose variance is 2 (256² − 1) / 12, as a number of mean 0 and deviation 1.
Float spread(Int hash, int shift) {
    constexpr float kDeviation = 104.51f;
    const Int sum = ((hash >> shift) & 0xFF) + ((hash >> (shift + 8)) & 0xFF);
    return Float(sum - 255) * (1.0f / kDeviation);
}

std::string grainSeedName(std::string_view name) {
    return "grain " + std::string(name);
}

}  // namespace

Vec2 Pass::grain2D(std::string_view name) {
    const Int position[] = {x(), y()};
    const Int bits = hash(grainSeedName(name), 0, position);
    return {spread(bits, 0), spread(bits, 16)};
}

Float Pass::grain(std::string_view name) {
    const Vec2 both = grain2D(name);
    constexpr float kRootOfHalf = 0.70710678f;
    return (both.x + both.y) * kRootOfHalf;
}

Float Pass::perlin2DWithGrain(std::string_view name, int size, std::vector<float> weights) {
    const float lost = lostDeviation(weights, size, step());
    const Float noise = perlin2D(name, size, std::move(weights));
    return lost == 0.0f ? noise : noise + grain(name) * lost;
}

}  // namespace terrane::gen
