#include "terrane/render/land/tint_textures.h"

#include <array>
#include <span>

#include "terrane/base/result.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

TintTextures TintTextures::create() {
    TintTextures made;
    made.textures_ = gpu::Texture2DArray({{shared::kTintTexels, shared::kTintTexels}, shared::kTintLevels, 1},
                                         GL_RGBA8, "tint");
    made.sampler_ = gpu::Sampler({.wrapS = GL_REPEAT, .wrapT = GL_REPEAT}, "tint");
    return made;
}

void TintTextures::set(world::ChunkPos tile, const world::TintTile& colors) {
    base::require(isUsed(), "Renderer::setTint: useTint(true) comes first");
    std::array<std::uint8_t, 4 * std::tuple_size_v<world::TintTile>> rgba;
    for (std::size_t k = 0; k < colors.size(); ++k) {
        for (const std::size_t channel : {0u, 1u, 2u})
            rgba[4 * k + channel] = static_cast<std::uint8_t>(colors[k] >> (16 - 8 * channel));
        rgba[4 * k + 3] = 255;
    }
    const ClipmapPlace place = clipmap_.placeOf(tile);
    textures_.uploadPart(place.level, {place.texel, {world::kChunkSize, world::kChunkSize}}, GL_RGBA,
                         GL_UNSIGNED_BYTE, std::as_bytes(std::span(rgba)));
    clipmap_.set(tile);
}

void TintTextures::writeUniforms(const Camera& camera, gpu::MappedRing& ring) const {
    if (!isUsed()) return;
    const shared::TintFrame frame = tintFrame(clipmap_, camera);
    ring.writeUniform(shared::kTintBinding, frame);
}

void TintTextures::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kTintUnit, textures_.id(), &sampler_);
}

}  // namespace terrane::render
