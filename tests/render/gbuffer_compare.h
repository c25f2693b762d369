// Compares what rays see with what quads draw: the G-buffer and the layers, pixel by pixel.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "terrane/render/frame/renderer.h"

namespace terrane::render {

// Rays are drawn in images so many times as large: each pixel has this number squared of rays, the middle one
// through its center.
constexpr int kRaysAcrossPixel = 5;

// What a target shows at each pixel: kind of face, and distance along the view; 0 if nothing.
struct SeenFaces {
    glm::ivec2 size{0};
    std::vector<std::uint32_t> kind;  // direction, whether of a far tile, of a layer whether of a liquid
    std::vector<float> distance;
};

inline SeenFaces seenIn(const Target& depth, const Target& packed, bool isLayer) {
    SeenFaces seen{depth.shape().size, {}, {}};
    const auto pixels = static_cast<std::size_t>(seen.size.x) * static_cast<std::size_t>(seen.size.y);
    std::vector<float> depths(pixels);
    std::vector<std::uint16_t> channels(4 * pixels);
    const auto bytes = [](const auto& values) { return static_cast<GLsizei>(values.size() * sizeof(values[0])); };
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, bytes(depths), depths.data());
    glGetTextureImage(packed.id(), 0, GL_RGBA, GL_UNSIGNED_SHORT, bytes(channels), channels.data());
    for (std::size_t k = 0; k < pixels; ++k) {
        const std::uint32_t alpha = channels[4 * k + 3];
        const std::uint32_t byte = alpha >> 8;
        const bool isFar = (byte & 7) == 7;
        seen.kind.push_back(isLayer ? alpha & 31 : isFar ? 8 | (byte >> 3 & 7) : byte & 7);
        seen.distance.push_back(depths[k] > 0 ? kNearPlane / depths[k] : 0.0f);
    }
    return seen;
}
inline SeenFaces seenSurfaces(const Renderer& renderer) {
    const SharedTargets& targets = renderer.frame().targets;
    return seenIn(*targets.depth, *targets.surfaces, false);
}
// A pixel without a face has the depth of the surface behind, and no kind.
inline SeenFaces seenLayer(const Renderer& renderer, std::size_t number) {
    const SharedTargets& targets = renderer.frame().targets;
    SeenFaces seen = seenIn(*targets.layerDepths[number], *targets.layers[number], true);
    const SeenFaces behind = seenSurfaces(renderer);
    for (std::size_t k = 0; k < seen.kind.size(); ++k) {
        const bool isThere = seen.distance[k] != behind.distance[k];
        seen.kind[k] = isThere ? seen.kind[k] : 99;
        seen.distance[k] = isThere ? seen.distance[k] : 0;
    }
    return seen;
}

struct FaceAgreement {
    int pixels = 0, shown = 0;  // all; those where rays see a face
    int tiles = 0;              // of these, those of far tiles
    int centers = 0;            // pixels that agree with the ray through their center
    int edges = 0;              // pixels that agree with another ray through them only
    int others = 0;             // pixels that agree with none

    FaceAgreement& operator+=(const FaceAgreement& other) {
        pixels += other.pixels;
        shown += other.shown;
        tiles += other.tiles;
        centers += other.centers;
        edges += other.edges;
        others += other.others;
        return *this;
    }
};

// `rays`: kRaysAcrossPixel times as large as `quads`. Upright sides of far tiles lie up to a quarter of a
// column deeper in the depth of quads than they are (quad.vert.glsl); columns are at most a 32nd of their
// distance wide, or two blocks.
inline FaceAgreement compareFaces(const SeenFaces& quads, const SeenFaces& rays) {
    const auto agrees = [&](std::size_t pixel, std::size_t ray) {
        if (quads.kind[pixel] != rays.kind[ray]) return false;
        const double drawn = quads.distance[pixel], seen = rays.distance[ray];
        const double tolerance = 0.01 + 2e-4 * seen;
        const bool isTileSide = (quads.kind[pixel] & ~7u) == 8 && (quads.kind[pixel] & 7) < 4;
        const double deeper = isTileSide ? 0.25 * std::max(2.0, seen / 32) : 0;
        return drawn >= seen - tolerance && drawn <= seen + deeper + tolerance;
    };
    constexpr int kMiddle = kRaysAcrossPixel / 2;
    FaceAgreement sum;
    for (int y = 0; y < quads.size.y; ++y) {
        for (int x = 0; x < quads.size.x; ++x) {
            const auto pixel = static_cast<std::size_t>(x + quads.size.x * y);
            const auto rayAt = [&](int dx, int dy) {
                return static_cast<std::size_t>(kRaysAcrossPixel * x + dx +
                                                rays.size.x * (kRaysAcrossPixel * y + dy));
            };
            ++sum.pixels;
            const std::size_t center = rayAt(kMiddle, kMiddle);
            sum.shown += rays.distance[center] > 0;
            sum.tiles += rays.distance[center] > 0 && (rays.kind[center] & ~7u) == 8;
            bool isEdge = false;
            for (int k = 0; k < kRaysAcrossPixel * kRaysAcrossPixel && !isEdge; ++k)
                isEdge = agrees(pixel, rayAt(k % kRaysAcrossPixel, k / kRaysAcrossPixel));
            ++(agrees(pixel, center) ? sum.centers : isEdge ? sum.edges : sum.others);
        }
    }
    return sum;
}

inline std::string textOf(const FaceAgreement& a) {
    return fmt::format("{} pixels, {} with faces ({} of tiles): {} agree with the ray through their center, {} "
                       "with another one, {} with none",
                       a.pixels, a.shown, a.tiles, a.centers, a.edges, a.others);
}

}  // namespace terrane::render
