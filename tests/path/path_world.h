// Small worlds for the path tracer, of blocks whose colors are known.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "terrane/base/image.h"
#include "terrane/path/film.h"
#include "terrane/path/scene.h"

namespace terrane::path {

constexpr world::Heights kPathHeights{0, 64};

// Textures are named by what they are: a byte of gray and a byte of alpha.
inline const world::BlockRegistry& pathBlocks() {
    static const world::BlockRegistry registry = world::BlockRegistry::parse(R"(
[[block]]
name = "white"
shape = "cube"
texture = "255_255"

[[block]]
name = "gray"
shape = "cube"
texture = "188_255"

[[block]]
name = "black"
shape = "cube"
texture = "0_255"

[[block]]
name = "lamp"
shape = "cube"
texture = "0_255"
alpha = "glow"
emission = [15, 15, 15]

[[block]]
name = "quarter_lamp"
like = "lamp"
texture = "quarter"

[[block]]
name = "gray_lamp"
shape = "cube"
texture = "188_255"
alpha = "glow"
emission = [15, 15, 15]

[[block]]
name = "water"
shape = "liquid"
texture = "128_200"
alpha = "blend"
two_sided = true
opacity = 1
)",
                                                                             "blocks")
                                                     .value();
    return registry;
}

// Black; a quarter of it glows, beside a corner.
inline base::Image quarterTexture() {
    base::Image image{4, 4, std::vector<std::uint8_t>(64, 0)};
    for (const std::size_t k : {0u, 1u, 4u, 5u}) image.rgba[4 * k + 3] = 255;
    return image;
}

inline std::vector<Texture> pathTextures() {
    return loadTextures(pathBlocks(),
                        [](std::string_view text) -> base::Result<base::Image> {
                            if (text == "quarter") return quarterTexture();
                            // That of unknown blocks has another name.
                            const std::string name(text.find('_') == text.npos ? "255_255" : text);
                            const std::size_t cut = name.find('_');
                            const auto gray = static_cast<std::uint8_t>(std::stoi(name.substr(0, cut)));
                            const auto alpha = static_cast<std::uint8_t>(std::stoi(name.substr(cut + 1)));
                            return base::Image{1, 1, {gray, gray, gray, alpha}};
                        })
        .value();
}

// Of "gray": 188 of 255 in sRGB.
inline double grayAlbedo() {
    return std::pow((188.0 / 255 + 0.055) / 1.055, 2.4);
}

using BlockAt = std::function<const char*(int x, int y, int z)>;  // null: air

inline SceneParts pathParts(const BlockAt& blockAt, Sky sky, int radius = 1) {
    SceneParts parts;
    parts.blocks = &pathBlocks();
    parts.heights = kPathHeights;
    parts.textures = pathTextures();
    parts.sky = std::move(sky);
    for (int cy = -radius; cy <= radius; ++cy) {
        for (int cx = -radius; cx <= radius; ++cx) {
            auto chunk = std::make_shared<world::Chunk>(kPathHeights);
            for (int z = 0; z < 64; ++z)
                for (int y = 0; y < 16; ++y)
                    for (int x = 0; x < 16; ++x)
                        if (const char* name = blockAt(16 * cx + x, 16 * cy + y, z))
                            chunk->setBlock(world::blockIndex(x, y, z), pathBlocks().find(name)->id);
            parts.tiles.push_back({{cx, cy}, std::move(chunk), {}});
        }
    }
    return parts;
}

// A camera that looks down on a spot, a thousandth of a block wide.
inline Camera lookDown(const glm::dvec3& position) {
    Camera camera;
    camera.position = position;
    camera.ahead = {0, 0, -1};
    camera.across = {5e-4f, 0, 0};
    camera.up = {0, 5e-4f, 0};
    return camera;
}

struct Estimate {
    double mean, error;  // error: the standard deviation of the mean
};
inline Estimate estimate(const Scene& scene, const Camera& camera, std::uint32_t samples,
                         int bounces = 1000) {
    const TraceOptions options{.size = {1, 1}, .seed = 7, .bounces = bounces};
    Tracer tracer(scene, camera, options);
    double sum = 0, squares = 0;
    for (std::uint32_t n = 0; n < samples; ++n) {
        const double value = double{tracer.trace({0, 0}, n).radiance.y};
        sum += value;
        squares += value * value;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt(std::max(squares / samples - mean * mean, 0.0) / samples)};
}

// Share of its hemisphere, by the cosine, that a point sees of a parallel square of side 2 · half whose
// middle is `distance` away along the normal (J. R. Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors, B-4).
inline double squareFactor(double half, double distance) {
    const double a = half / distance, root = std::sqrt(1 + a * a);
    return 4 * 2 * (a / root * std::atan(a / root)) / (2 * std::acos(-1.0));
}

}  // namespace terrane::path
