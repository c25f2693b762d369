#include "terrane/render/quads/quad_resources.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "terrane/mesh/shape_faces.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/frame.h"
#include "terrane/shared/material.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {
namespace {

static_assert(static_cast<shared::uint>(world::AlphaMode::TestGlow) == shared::kAlphaTestGlow);
static_assert(static_cast<shared::uint>(world::AlphaMode::Tint) == shared::kAlphaTint);
static_assert(static_cast<shared::uint>(world::Wrap::Clamp) == shared::kWrapClamp);
static_assert(static_cast<shared::uint>(world::Filtering::Nearest) == shared::kFilteringNearest);
static_assert(static_cast<shared::uint>(world::Animation::LiquidSurface) == shared::kAnimationLiquidSurface);

// Corners 0 1 2, 2 1 3 of each quad; 6 × 16,384 × 2 bytes = 192 KiB.
gpu::Buffer quadIndices() {
    std::vector<std::uint16_t> indices;
    for (std::uint32_t quad = 0; quad < shared::kMaxQuadsPerCommand; ++quad) {
        for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) {
            indices.push_back(static_cast<std::uint16_t>(4 * quad + corner));
        }
    }
    return gpu::Buffer(std::as_bytes(std::span(indices)), 0, "quad indices");
}

shared::uint optionsOf(const world::Material& m, std::uint8_t doublings) {
    assert(m.surface.heightUnits <= shared::kSurfaceUnits && m.surface.waveUnits < 256 && doublings < 16 &&
           "the parser and the largest texture keep them within their bits");
    return shared::packOptions({.wrap = static_cast<shared::uint>(m.wrap),
                                .filtering = static_cast<shared::uint>(m.filtering),
                                .doublings = doublings,
                                .surfaceHeight = m.surface.heightUnits,
                                .waveHeight = m.surface.waveUnits,
                                .tinted = m.tinted ? 1u : 0u});
}

gpu::Buffer materialRecords(const world::BlockRegistry& blocks, const BlockTextures& textures) {
    std::vector<shared::MaterialRecord> records;
    for (const world::Material& m : blocks.materials()) {
        records.push_back({shared::packLook(m.texture, static_cast<shared::uint>(m.alpha),
                                            static_cast<shared::uint>(m.animation)),
                           optionsOf(m, textures.doublings[m.texture]), textures.meanColors[m.texture], 0});
    }
    return gpu::Buffer(std::as_bytes(std::span(records)), 0, "materials");
}

}  // namespace

QuadResources::QuadResources(const world::BlockRegistry& blocks, BlockTextures textures, float anisotropy)
    : tables_{mesh::shapeFaces(blocks), {}},
      smooth_({.minFilter = GL_LINEAR_MIPMAP_LINEAR,
               .magFilter = GL_LINEAR,
               .wrapS = GL_REPEAT,
               .wrapT = GL_REPEAT,
               .maxAnisotropy = anisotropy},
              "block textures, smooth"),
      nearest_({.minFilter = GL_NEAREST_MIPMAP_NEAREST,
                .magFilter = GL_NEAREST,
                .wrapS = GL_REPEAT,
                .wrapT = GL_REPEAT},
               "block textures, nearest"),
      indices_(quadIndices()),
      shapeFaces_(std::as_bytes(std::span<const shared::ShapeFace>(tables_.shapeFaces)), 0, "shape faces"),
      shapeFaceTexels_(shapeFaces_, GL_RGBA32F, "shape faces"),
      vertexArray_("quads") {
    vertexArray_.setElementBuffer(indices_);
    for (const world::Material& m : blocks.materials())
        tables_.isWaving.push_back(m.animation != world::Animation::None);
    setTextures(blocks, std::move(textures));
}

void QuadResources::setTextures(const world::BlockRegistry& blocks, BlockTextures textures) {
    textures_ = std::move(textures);
    materials_ = materialRecords(blocks, textures_);
    materialTexels_ = gpu::BufferTexture(materials_, GL_RGBA32UI, "materials");
    hasFaceSampling_ = needsFaceSampling(blocks, textures_);
}

std::size_t QuadResources::gpuBytes() const {
    return textures_.array.sizeBytes() + indices_.sizeBytes() + shapeFaces_.sizeBytes() +
           materials_.sizeBytes();
}

void QuadResources::bindTables() const {
    shapeFaceTexels_.bind(shared::kShapeFacesUnit);
    materialTexels_.bind(shared::kMaterialsUnit);
}

void QuadResources::bindTextures(bool isSmooth) const {
    textures_.array.bind(shared::kBlockTexturesUnit);
    (isSmooth ? smooth_ : nearest_).bind(shared::kBlockTexturesUnit);
    if (hasFaceSampling_) {
        textures_.array.bind(shared::kSmoothTexturesUnit);
        smooth_.bind(shared::kSmoothTexturesUnit);
        textures_.array.bind(shared::kNearestTexturesUnit);
        nearest_.bind(shared::kNearestTexturesUnit);
    }
}

void QuadResources::bind(const gpu::Buffer& drawRecords, bool isSmooth) {
    bindTables();
    bindTextures(isSmooth);
    vertexArray_.setInstanceIntegers(shared::kDrawRecordAttribute, drawRecords,
                                     sizeof(shared::DrawRecord) / sizeof(GLint), sizeof(shared::DrawRecord));
    vertexArray_.bind();
}

bool needsFaceSampling(const world::BlockRegistry& blocks, const BlockTextures& textures) {
    const auto hasOwnWay = [](const world::Material& m) {
        return m.wrap != world::Wrap::Quad || m.filtering != world::Filtering::Option;
    };
    return std::ranges::any_of(blocks.materials(), hasOwnWay) ||
           std::ranges::any_of(textures.doublings, [](std::uint8_t n) { return n > 0; });
}

}  // namespace terrane::render
