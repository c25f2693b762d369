#include "terrane/render/land/land_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "terrane/base/profile.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

template <class T>
T packed(float share) {
    constexpr float kMax = static_cast<float>(static_cast<T>(~T{0}));
    return static_cast<T>(std::clamp(share, 0.0f, 1.0f) * kMax + 0.5f);
}

// Heights of edges, as in LandFrame.
glm::vec2 edgeHeights(const LandMap& map) {
    return {map.lowestEdge(), static_cast<float>(map.heights().layers()) + 2 * shared::kLandBeyond};
}

// See shared/land.h.
bool needsFloats(const LandMap& map) {
    return edgeHeights(map).y / 65536 > 1.0f / 32;
}

// Of each texel the share of the height, then that of the edge.
std::vector<float> shadowShares(const LandMap& map, const LandLevel& level) {
    const glm::vec2 heights = edgeHeights(map);
    std::vector<float> shares;
    shares.reserve(2 * level.edges.size());
    for (const LandEdge& edge : level.edges) {
        shares.push_back((edge.begin - heights.x) / heights.y);
        shares.push_back(edge.edge / shared::kLandMaxEdge);
    }
    return shares;
}

using GroundTexel = std::array<std::uint8_t, 4>;

std::vector<GroundTexel> groundTexels(const LandLevel& level) {
    std::vector<GroundTexel> texels;
    texels.reserve(level.sky.size());
    for (std::size_t k = 0; k < level.sky.size(); ++k) {
        const glm::vec3 color = level.ground[k];
        texels.push_back({packed<std::uint8_t>(color.x), packed<std::uint8_t>(color.y),
                          packed<std::uint8_t>(color.z), packed<std::uint8_t>(level.sky[k])});
    }
    return texels;
}

}  // namespace

LandTextures LandTextures::create(world::TopColors colors, world::Heights heights) {
    constexpr gpu::Texture2DArray::Shape kShape{{Clipmap::kTexels, Clipmap::kTexels}, shared::kLandLevels, 1};
    LandTextures made;
    made.map_ = LandMap(std::move(colors), heights);
    made.shadows_ = gpu::Texture2DArray(kShape, needsFloats(made.map_) ? GL_RG32F : GL_RG16, "land shadows");
    made.ground_ = gpu::Texture2DArray(kShape, GL_RGBA8, "land ground");
    made.sampler_ = gpu::Sampler({}, "land");
    return made;
}

void LandTextures::update(const Camera& camera, const LandLight& light, int limit) {
    if (!isUsed()) return;
    TERRANE_ZONE("land light");
    for (const auto& [number, hasNewGround] : map_.update(cameraChunk(camera), light, limit)) {
        const LandLevel& level = map_.level(number);
        const std::vector<float> shadows = shadowShares(map_, level);
        if (needsFloats(map_)) {
            shadows_.upload(0, number, GL_RG, GL_FLOAT, std::as_bytes(std::span(shadows)));
        } else {
            std::vector<std::uint16_t> texels(shadows.size());
            std::ranges::transform(shadows, texels.begin(), packed<std::uint16_t>);
            shadows_.upload(0, number, GL_RG, GL_UNSIGNED_SHORT, std::as_bytes(std::span(texels)));
        }
        if (!hasNewGround) continue;
        const auto ground = groundTexels(level);
        ground_.upload(0, number, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(ground)));
    }
}

void LandTextures::writeUniforms(const Camera& camera, gpu::MappedRing& ring) const {
    if (!isUsed()) return;
    const shared::LandFrame frame = landFrame(map_, camera);
    ring.writeUniform(shared::kLandBinding, frame);
}

void LandTextures::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kLandShadowUnit, shadows_.id(), &sampler_)
        .add(shared::kLandGroundUnit, ground_.id(), &sampler_);
}

// In doubles: a level's corner may be 2^31 blocks away from 0.
shared::LandFrame landFrame(const LandMap& map, const Camera& camera) {
    shared::LandFrame frame{};
    frame.heights = glm::vec4(edgeHeights(map), 0, 0);
    const world::ChunkPos chunk = cameraChunk(camera);
    for (int number = 0; number < LandTextures::kAllLevels; ++number) {
        const LandLevel& level = map.level(number);
        if (!level.exists()) continue;
        const double texel = kLandClipmap.texelBlocks(number), side = texel * Clipmap::kTexels;
        const auto along = [&](std::int32_t chunkAt, int corner) {
            return static_cast<float>((static_cast<double>(chunkAt) * world::kChunkSize - corner * texel) /
                                      side);
        };
        frame.levels[number] = {along(chunk.x, level.corner.x), along(chunk.y, level.corner.y),
                                static_cast<float>(1 / side), 1};
    }
    return frame;
}

}  // namespace terrane::render
