// Compares what rays see with what quads draw: the G-buffer and the layers, pixel by pixel.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "terrane/render/frame/renderer.h"

namespace terrane::render {

// Rays are drawn in images of the same size and in finer ones, so many times as large.
constexpr int kRaysAcrossPixel = 5;

// What a target shows at each pixel: kind of face, and distance along the view; 0 if nothing.
struct SeenFaces {
    glm::ivec2 size{0};
    std::vector<std::uint32_t> kind;  // direction, whether of a far tile, of a layer whether of a liquid
    std::vector<float> distance;
};

constexpr std::uint32_t kNoKind = 99;

inline SeenFaces seenIn(const Target& depth, const Target& packed, bool isLayer) {
    SeenFaces seen{depth.shape().size, {}, {}};
    const auto pixels = static_cast<std::size_t>(seen.size.x) * static_cast<std::size_t>(seen.size.y);
    std::vector<float> depths(pixels);
    std::vector<std::uint16_t> channels(4 * pixels);
    const auto bytes = [](const auto& values) {
        return static_cast<GLsizei>(values.size() * sizeof(values[0]));
    };
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
// A pixel without a face has the depth of the surface behind, and no kind. A face in the plane of the surface
// behind, such as the back of glass beside leaves, does not count: rounding decides which of them is nearer.
// Layers of quads are not written where no mesh section has a face: the targets are cleared before the frame,
// by clearLayers().
inline SeenFaces seenLayer(const Renderer& renderer, std::size_t number) {
    const SharedTargets& targets = renderer.frame().targets;
    SeenFaces seen = seenIn(*targets.layerDepths[number], *targets.layers[number], true);
    const SeenFaces behind = seenSurfaces(renderer);
    for (std::size_t k = 0; k < seen.kind.size(); ++k) {
        constexpr float kBefore = 1 - 1 / 65536.0f;
        const bool isThere = seen.distance[k] > 0 &&
                             (behind.distance[k] == 0 || seen.distance[k] < kBefore * behind.distance[k]);
        seen.kind[k] = isThere ? seen.kind[k] : kNoKind;
        seen.distance[k] = isThere ? seen.distance[k] : 0;
    }
    return seen;
}
inline void clearLayers(const Renderer& renderer) {
    constexpr float kFarthest = 0;
    for (const TargetRef& depth : renderer.frame().targets.layerDepths)
        glClearTexImage(depth->id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &kFarthest);
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

// `rays`: of the same size. `fine`: kRaysAcrossPixel times as large. Upright sides of far tiles lie up to a
// quarter of a column deeper in the depth of quads than they are (quad.vert.glsl); columns are at most a 32nd
// of their distance wide, or two blocks.
inline FaceAgreement compareFaces(const SeenFaces& quads, const SeenFaces& rays, const SeenFaces& fine) {
    // `slope`: by how much the distance of faces of this kind changes within the pixel. Corners of quads are
    // off by up to a 256th of a pixel on the screen, which tilts small ones that are seen edge on.
    const auto agrees = [&](std::size_t pixel, const SeenFaces& seen, std::size_t ray, double slope) {
        const double drawn = quads.distance[pixel], met = seen.distance[ray];
        const double tolerance = 0.01 + 2e-4 * met + slope / 16;
        const bool isTileSide = (quads.kind[pixel] & ~7u) == 8 && (quads.kind[pixel] & 7) < 4;
        const double deeper = isTileSide ? 0.25 * std::max(2.0, met / 32) : 0;
        return drawn >= met - tolerance && drawn <= met + deeper + tolerance;
    };
    FaceAgreement sum;
    for (int y = 0; y < quads.size.y; ++y) {
        for (int x = 0; x < quads.size.x; ++x) {
            const auto pixel = static_cast<std::size_t>(x + quads.size.x * y);
            std::vector<std::size_t> around;
            double low = 1e9, high = 0;
            for (int k = 0; k < kRaysAcrossPixel * kRaysAcrossPixel; ++k) {
                around.push_back(
                    static_cast<std::size_t>(kRaysAcrossPixel * x + k % kRaysAcrossPixel +
                                             fine.size.x * (kRaysAcrossPixel * y + k / kRaysAcrossPixel)));
                if (fine.kind[around.back()] != quads.kind[pixel]) continue;
                low = std::min(low, double{fine.distance[around.back()]});
                high = std::max(high, double{fine.distance[around.back()]});
            }
            const double slope = std::max(high - low, 0.0);
            ++sum.pixels;
            sum.shown += rays.distance[pixel] > 0;
            sum.tiles += rays.distance[pixel] > 0 && (rays.kind[pixel] & ~7u) == 8;
            // Two faces that meet at an edge have one distance there; quads grow over it.
            const bool isNear = agrees(pixel, rays, pixel, slope);
            const bool isEdge =
                isNear || std::ranges::any_of(around, [&](std::size_t ray) {
                    return quads.kind[pixel] == fine.kind[ray] && agrees(pixel, fine, ray, slope);
                });
            const bool isSame = isNear && quads.kind[pixel] == rays.kind[pixel];
            ++(isSame ? sum.centers : isEdge ? sum.edges : sum.others);
        }
    }
    return sum;
}

inline std::string textOf(const FaceAgreement& a) {
    return fmt::format(
        "{} pixels, {} with faces ({} of tiles): {} agree with the ray through their center, {} "
        "with another one, {} with none",
        a.pixels, a.shown, a.tiles, a.centers, a.edges, a.others);
}

}  // namespace terrane::render
