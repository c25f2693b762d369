#include "terrane/render/quad_resources.h"

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

gpu::Buffer materialRecords(const world::BlockRegistry& blocks) {
    std::vector<shared::MaterialRecord> records;
    for (const world::Material& m : blocks.materials()) {
        records.push_back(
            {m.texture, static_cast<shared::uint>(m.alpha), static_cast<shared::uint>(m.animation), 0});
    }
    return gpu::Buffer(std::as_bytes(std::span(records)), 0, "materials");
}

}  // namespace

QuadResources::QuadResources(const world::BlockRegistry& blocks, gpu::Texture2DArray textures,
                             float anisotropy)
    : textures_(std::move(textures)),
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
      shapeFaces_(std::as_bytes(mesh::shapeFaces()), 0, "shape faces"),
      materials_(materialRecords(blocks)),
      shapeFaceTexels_(shapeFaces_, GL_RGBA32F, "shape faces"),
      materialTexels_(materials_, GL_RGBA32UI, "materials"),
      vertexArray_("quads") {
    vertexArray_.setElementBuffer(indices_);
}

std::size_t QuadResources::gpuBytes() const {
    return textures_.sizeBytes() + indices_.sizeBytes() + shapeFaces_.sizeBytes() + materials_.sizeBytes();
}

void QuadResources::bind(const MeshSectionTable& meshSections, bool isSmooth) {
    shapeFaceTexels_.bind(shared::kShapeFacesUnit);
    materialTexels_.bind(shared::kMaterialsUnit);
    constexpr GLint kChunkAndLevel = 3;
    static_assert(offsetof(shared::MeshSectionRecord, level) == 2 * sizeof(GLint));
    vertexArray_.setInstanceIntegers(shared::kMeshSectionChunkAttribute, meshSections.records(),
                                     kChunkAndLevel, sizeof(shared::MeshSectionRecord));
    textures_.bind(shared::kBlockTexturesUnit);
    (isSmooth ? smooth_ : nearest_).bind(shared::kBlockTexturesUnit);
    vertexArray_.bind();
}

}  // namespace terrane::render
