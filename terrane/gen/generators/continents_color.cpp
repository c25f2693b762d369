// The color of grass and leaves on continents: by temperature and moisture, with soft borders.
#include "terrane/gen/expr_math.h"
#include "terrane/gen/generators/continents.h"

namespace terrane::gen::continents {
namespace {

// sRGB, 0…1
struct Color {
    float red, green, blue;
};

// From cold to hot, dry and wet.
constexpr Color kDry[] = {{0.52f, 0.53f, 0.36f}, {0.50f, 0.56f, 0.24f}, {0.72f, 0.64f, 0.33f}};
constexpr Color kWet[] = {{0.31f, 0.47f, 0.30f}, {0.31f, 0.51f, 0.17f}, {0.25f, 0.48f, 0.13f}};

}  // namespace

void colorPass(Pass& p, const Fields& f) {
    const Float patches = p.simplex2D("grass colors", 64, {.02f, .03f, .05f, .05f});
    const Float high = max(p.read(f.base) - (kSea + 20.0f), Float(0.0f)) * 0.0045f;
    const Float warm = clamp(p.read(f.temperature) - high + patches, -0.6f, 0.6f) * (1.0f / 0.6f);
    const Float wet = smoothstep(-0.5f, 0.4f, p.read(f.moisture) + patches);
    const auto channel = [&](float Color::*c) {
        const auto between = [&](const Color(&colors)[3]) {
            const Float cool = lerp(Float(colors[1].*c), Float(colors[0].*c), max(-warm, Float(0.0f)));
            return select(warm < 0.0f, cool,
                          lerp(Float(colors[1].*c), Float(colors[2].*c), max(warm, Float(0.0f))));
        };
        return lerp(between(kDry), between(kWet), wet);
    };
    p.set(f.color, packColor(channel(&Color::red), channel(&Color::green), channel(&Color::blue)));
}

}  // namespace terrane::gen::continents
