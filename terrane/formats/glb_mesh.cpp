#include "terrane/formats/glb_mesh.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "terrane/base/image.h"
#include "terrane/mesh/shape_faces.h"

namespace terrane::formats {
namespace {

using shared::ShapeFace;
using world::AlphaMode;

glm::vec3 toGltf(glm::vec3 v) {
    return {v.x, v.z, -v.y};
}

GlbAlpha alphaOf(AlphaMode alpha) {
    switch (alpha) {
        case AlphaMode::Test:
        case AlphaMode::TestGlow:
            return GlbAlpha::Mask;
        case AlphaMode::Blend:
            return GlbAlpha::Blend;
        default:
            return GlbAlpha::Opaque;
    }
}

GlbImageUse useOf(AlphaMode alpha, bool isGlow) {
    if (alpha == AlphaMode::TestGlow) return isGlow ? GlbImageUse::GlowAboveHoles : GlbImageUse::Holes;
    if (isGlow) return GlbImageUse::Glow;
    return alphaOf(alpha) == GlbAlpha::Opaque ? GlbImageUse::Opaque : GlbImageUse::Alpha;
}

// Converts alpha to holes and coverage, the only meanings in glTF. A glow image has the light that each texel
// emits: its color times its share of glow (world::AlphaMode).
void prepareImage(base::Image& image, GlbImageUse use) {
    if (use == GlbImageUse::Alpha) return;
    for (std::size_t k = 0; k + 3 < image.rgba.size(); k += 4) {
        const int alpha = std::exchange(image.rgba[k + 3], std::uint8_t{255});
        if (use == GlbImageUse::Holes && alpha < 64) image.rgba[k + 3] = 0;
        if (use != GlbImageUse::Glow && use != GlbImageUse::GlowAboveHoles) continue;
        const int share = use == GlbImageUse::Glow ? alpha : std::max(2 * alpha - 255, 0);
        for (std::size_t c = 0; c < 3; ++c)
            image.rgba[k + c] = static_cast<std::uint8_t>(image.rgba[k + c] * share / 255);
    }
}

std::string_view suffixOf(GlbImageUse use) {
    if (use == GlbImageUse::Opaque) return "";
    return use == GlbImageUse::Alpha || use == GlbImageUse::Holes ? "_alpha" : "_glow";
}

}  // namespace

GlbMesh::GlbMesh(const world::BlockRegistry& blocks, const world::TextureSource& textures)
    : blocks_(blocks), textures_(textures), faces_(mesh::shapeFaces(blocks)) {}

base::Result<void> GlbMesh::add(const mesh::ChunkMesh& mesh, glm::ivec3 corner) {
    quads_ += mesh.quads.size();
    if (quads_ > kMaxGlbQuads)
        return base::fail(base::ErrorCode::OutOfResources,
                          "more than {} faces; choose a smaller area, or a box without the ground",
                          kMaxGlbQuads);
    for (const mesh::MeshSection& section : mesh.meshSections) {
        const glm::ivec3 origin = corner + glm::ivec3(0, 0, mesh::quadBase(section));
        for (const shared::Quad quad :
             std::span(mesh.quads).subspan(mesh::firstQuad(section), mesh::quadCount(section)))
            addQuad(quad, origin);
    }
    return {};
}

void GlbMesh::addQuad(shared::Quad quad, glm::ivec3 corner) {
    const ShapeFace& face = faces_[shared::quadShapeFace(quad)];
    const glm::vec2 extent(shared::quadExtentU(quad), shared::quadExtentV(quad));
    const shared::vec4 cell(static_cast<float>(shared::quadX(quad)), static_cast<float>(shared::quadY(quad)),
                            static_cast<float>(shared::quadZ(quad)), 0);
    const glm::vec3 normal = toGltf(mesh::normalOf(face));
    GlbPart& part = parts_[{shared::quadMaterial(quad), shared::isTwoSidedFace(face)}];
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    constexpr std::array<std::array<float, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (const auto& [u, v] : kCorners) {
        const glm::vec2 at(u, v);
        const glm::vec3 position(shared::shapeFaceCorner(face, cell, at, extent));
        part.vertices.push_back(
            {toGltf(position + glm::vec3(corner)), normal, shared::shapeFaceTexel(face, at) * extent});
    }
    // The diagonal that the renderer draws (quad_resources.cpp): quads that are no parallelograms differ by
    // it.
    for (const std::uint32_t k : {0u, 1u, 3u, 3u, 1u, 2u}) part.indices.push_back(first + k);
}

base::Result<std::size_t> GlbMesh::imageOf(const world::Material& material, bool isGlow, GlbModel& model) {
    const std::string& texture = blocks_.textures()[material.texture];
    const GlbImageUse use = useOf(material.alpha, isGlow);
    const auto [place, isNew] = imageNumbers_.try_emplace({texture, use}, model.images.size());
    if (!isNew) return place->second;
    auto image = TERRANE_TRY(textures_(texture));
    prepareImage(image, use);
    auto png = TERRANE_TRY(base::encodePng(image));
    model.images.push_back({texture + std::string(suffixOf(use)), std::move(png)});
    return place->second;
}

base::Result<GlbModel> GlbMesh::finish(std::string name) {
    if (parts_.empty()) return base::fail(base::ErrorCode::NotFound, "there is nothing but air in the area");
    GlbModel model;
    model.name = std::move(name);
    for (auto& [key, part] : parts_) {
        const auto& [number, isTwoSided] = key;
        const world::Material& material = blocks_.materials()[number];
        const auto image = TERRANE_TRY(imageOf(material, false, model));
        part.image = image;
        part.name = model.images[image].name;
        part.alpha = alphaOf(material.alpha);
        part.isTwoSided = material.twoSided || isTwoSided;
        if (material.alpha == AlphaMode::Glow || material.alpha == AlphaMode::TestGlow) {
            const auto glow = TERRANE_TRY(imageOf(material, true, model));
            part.glow = static_cast<int>(glow);
        }
        model.parts.push_back(std::move(part));
    }
    return model;
}

}  // namespace terrane::formats
