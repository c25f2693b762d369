#include "terrane/path/scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "terrane/base/image.h"
#include "terrane/base/srgb.h"
#include "terrane/mesh/shape_faces.h"

namespace terrane::path {
namespace {

using world::AlphaMode, world::BlockType, world::Material;

const std::array<float, 256>& decodedBytes() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] = base::decodeSrgb(static_cast<float>(k) / 255);
        return values;
    }();
    return table;
}

// As block_tint.glsl: a texel takes a share of the tint.
glm::vec3 tinted(glm::vec3 color, world::PackedColor packed, float share) {
    constexpr glm::vec3 kNeutral =
        glm::vec3(shared::kNeutralTintRed, shared::kNeutralTintGreen, shared::kNeutralTintBlue) / 255.0f;
    const glm::vec3 atNeutral = kNeutral / (1.0f - kNeutral), atWhite = 1.0f / (1.0f - kNeutral);
    const glm::vec3 tint =
        glm::max(glm::vec3(packed >> 16 & 255, packed >> 8 & 255, packed & 255), 1.0f) / 255.0f;
    return color * tint / (tint + share * (1.0f - color) * (atNeutral - atWhite * tint));
}

// Alpha of a texel of a material: its glow, and whether it is a hole.
float glowOf(AlphaMode mode, float alpha) {
    if (mode == AlphaMode::Glow) return alpha;
    return mode == AlphaMode::TestGlow ? glm::clamp(2 * alpha - 1, 0.0f, 1.0f) : 0;
}
bool isHole(AlphaMode mode, float alpha) {
    if (mode == AlphaMode::TestGlow) return alpha < 0.25f;
    return mode == AlphaMode::Test && alpha < 0.5f;
}

// Light of a block that emits: that of its glowing texels, or of all if its texture has no glow.
float emittingShare(AlphaMode mode, float alpha) {
    if (isHole(mode, alpha)) return 0;
    return mode == AlphaMode::Glow || mode == AlphaMode::TestGlow ? glowOf(mode, alpha) : 1;
}

// What a face emits: its mean share over the part of the texture that it shows, and the box of texels that
// emit, 0 to 1.
struct EmittingTexels {
    float meanShare = 0;
    glm::vec2 low{1}, high{0};
};
EmittingTexels emittingTexelsOf(const shared::ShapeFace& face, const Material& material,
                                const std::vector<Texture>& textures) {
    const Texture& texture = textures[material.texture];
    const auto side = static_cast<float>(texture.side);
    const glm::vec2 a = shared::shapeFaceTexel(face, {0, 0}), b = shared::shapeFaceTexel(face, {1, 1});
    const glm::ivec2 low(glm::floor(glm::min(a, b) * side)), end(glm::ceil(glm::max(a, b) * side));
    EmittingTexels found;
    for (int y = low.y; y < end.y; ++y) {
        for (int x = low.x; x < end.x; ++x) {
            const std::size_t k = 4 * static_cast<std::size_t>(y * texture.side + x) + 3;
            const float share = emittingShare(material.alpha, static_cast<float>(texture.rgba[k]) / 255);
            if (share == 0) continue;
            found.meanShare += share;
            found.low = glm::min(found.low, glm::vec2(x, y) / side);
            found.high = glm::max(found.high, glm::vec2(x + 1, y + 1) / side);
        }
    }
    const glm::ivec2 shown = end - low;
    if (shown.x > 0 && shown.y > 0) found.meanShare /= static_cast<float>(shown.x * shown.y);
    return found;
}

struct FaceGeometry {
    glm::vec3 corner, alongU, alongV;
    float area() const { return glm::length(glm::cross(alongU, alongV)); }
};
FaceGeometry geometryOf(const shared::ShapeFace& face) {
    const auto at = [&](float u, float v) {
        return glm::vec3(shared::shapeFaceCorner(face, shared::vec4(0), {u, v}, {1, 1}));
    };
    const glm::vec3 corner = at(0, 0);
    return {corner, at(1, 0) - corner, at(0, 1) - corner};
}

// The part of a face that shows a box of its texture, along its axes. Texture coordinates of faces without a
// bend change along one axis each.
struct FacePart {
    glm::vec2 low, high;
};
FacePart partOf(const shared::ShapeFace& face, const EmittingTexels& texels) {
    const glm::vec2 origin = shared::shapeFaceTexel(face, {0, 0});
    const glm::mat2 axes(shared::shapeFaceTexel(face, {1, 0}) - origin,
                         shared::shapeFaceTexel(face, {0, 1}) - origin);
    const glm::mat2 toFace = glm::inverse(axes);
    const glm::vec2 a = toFace * (texels.low - origin), b = toFace * (texels.high - origin);
    return {glm::clamp(glm::min(a, b), 0.0f, 1.0f), glm::clamp(glm::max(a, b), 0.0f, 1.0f)};
}

int sideBitsFor(const SceneParts& parts) {
    int most = 1;
    for (const SceneTile& tile : parts.tiles) {
        const int level = tile.pos.level;
        most = std::max({most, std::abs(tile.pos.x - (parts.center.x >> level)),
                         std::abs(tile.pos.y - (parts.center.y >> level))});
    }
    // Tiles are less than half of the window from the center.
    return std::max(4, static_cast<int>(std::bit_width(static_cast<unsigned>(2 * most + 4))));
}

}  // namespace

base::Result<std::vector<Texture>> loadTextures(const world::BlockRegistry& blocks,
                                                const world::TextureSource& source) {
    std::vector<Texture> textures;
    for (const std::string& name : blocks.textures()) {
        base::Image image = TERRANE_TRY(source(name));
        if (image.width != image.height || !std::has_single_bit(static_cast<unsigned>(image.width)))
            return base::fail("texture \"{}\": {}×{} is not square with a power of two", name, image.width,
                              image.height);
        textures.push_back({image.width, std::move(image.rgba)});
    }
    return textures;
}

Scene::Scene(SceneParts given)
    : parts(std::move(given)), farBlocks(parts.blocks->forFarTiles()), sideBits_(sideBitsFor(parts)) {
    for (const SceneTile& tile : parts.tiles) levels_ = std::max(levels_, 1 + tile.pos.level);
    grid_.resize(static_cast<std::size_t>(levels_) << 2 * sideBits_);
    cells = rays::makeScene(parts.heights, levels_, sideBits_);
    rays::moveScene(cells, parts.center);
    const rays::StopTable near = rays::drawnBlocks(*parts.blocks), far = rays::drawnBlocks(farBlocks);
    for (const SceneTile& tile : parts.tiles) {
        grid_[slotOf(tile.pos)] = &tile;
        rays::setTile(cells, tile.pos, rays::buildColumn(*tile.chunk, tile.pos.level > 0 ? far : near));
    }
    surfaces = {.cells = rays::raysThrough(cells),
                .chunkAt =
                    [this](world::ChunkPos pos) {
                        const SceneTile* tile = tileAt(pos);
                        return tile != nullptr ? tile->chunk.get() : nullptr;
                    },
                .blocks = parts.blocks,
                .farBlocks = &farBlocks,
                .shapeFaces = mesh::shapeFaces(*parts.blocks)};
    setEmission();
    emitters = EmitterTable(findEmitters());
}

// The faces of a block that stands alone emit as much as a cube of the radiance of its level.
void Scene::setEmission() {
    std::vector<mesh::CellFace> faces;
    for (const BlockType& type : parts.blocks->types()) {
        glm::vec3 radiance(0);
        for (int c = 0; c < 3; ++c) {
            const float level = static_cast<float>(type.emission[static_cast<std::size_t>(c)]) / 15;
            radiance[c] = kLampRadiance * std::pow(level, kLampPower);
        }
        if (radiance != glm::vec3(0)) {
            mesh::CellSurroundings alone;
            alone.self.id = type.id;
            faces.clear();
            mesh::addCellFaces(alone, *parts.blocks, faces);
            float area = 0;
            for (const mesh::CellFace& face : faces)
                area += geometryOf(surfaces.shapeFaces[face.shapeFace]).area() *
                        emittingTexelsOf(surfaces.shapeFaces[face.shapeFace],
                                         parts.blocks->materials()[face.material], parts.textures)
                            .meanShare *
                        (face.isTwoSided ? 2.0f : 1.0f);
            radiance *= area > 0 ? 6 / area : 0;
        }
        emission.push_back(radiance);
    }
}

std::vector<Emitter> Scene::findEmitters() const {
    std::vector<Emitter> found;
    std::vector<mesh::CellFace> faces;
    const auto emits = [&](world::BlockId id) {
        return id < emission.size() && emission[id] != glm::vec3(0);
    };
    std::map<std::pair<std::uint16_t, std::uint16_t>, EmittingTexels> known;  // by face and material
    for (const SceneTile& tile : parts.tiles) {
        if (tile.pos.level > 0) continue;  // too small to be seen, and their light too weak
        const world::Chunk& chunk = *tile.chunk;
        for (int s = chunk.heights().firstSection(); s < chunk.heights().endSection(); ++s) {
            if (chunk.section(s).surelyAll([&](world::BlockId id) { return !emits(id); })) continue;
            for (int k = 0; k < world::kBlocksPerSection; ++k) {
                const world::BlockIndex at = s * world::kBlocksPerSection + k;
                const world::BlockId id = chunk.block(at);
                if (!emits(id)) continue;
                const glm::ivec3 in(at & 15, at >> 4 & 15, at >> 8);
                faces.clear();
                rays::addFacesOf(surfaces, tile.pos, in, faces);
                for (const mesh::CellFace& face : faces) {
                    const shared::ShapeFace& shape = surfaces.shapeFaces[face.shapeFace];
                    const auto [texels, isNew] = known.try_emplace({face.shapeFace, face.material});
                    if (isNew)
                        texels->second =
                            emittingTexelsOf(shape, parts.blocks->materials()[face.material], parts.textures);
                    if (texels->second.meanShare == 0) continue;
                    const FaceGeometry g = geometryOf(shape);
                    const FacePart part = partOf(shape, texels->second);
                    const glm::vec2 size = part.high - part.low;
                    if (size.x <= 0 || size.y <= 0) continue;
                    const glm::dvec3 cell(tile.pos.x * 16.0 + in.x, tile.pos.y * 16.0 + in.y, in.z);
                    const glm::vec3 corner = g.corner + g.alongU * part.low.x + g.alongV * part.low.y;
                    found.push_back({.tile = tile.pos,
                                     .block = at,
                                     .shapeFace = face.shapeFace,
                                     .material = face.material,
                                     .isTwoSided = face.isTwoSided,
                                     .corner = cell + glm::dvec3(corner),
                                     .alongU = g.alongU * size.x,
                                     .alongV = g.alongV * size.y,
                                     .normal = mesh::normalOf(shape),
                                     .area = g.area() * size.x * size.y,
                                     .power = luminance(emission[id]) * g.area() * texels->second.meanShare *
                                              (face.isTwoSided ? 2.0f : 1.0f)});
                }
            }
        }
    }
    return found;
}

const BlockType& blockOf(const Scene& scene, const rays::Surface& surface) {
    const world::BlockRegistry& blocks = surface.tile.level == 0 ? *scene.parts.blocks : scene.farBlocks;
    return blocks.type(scene.tileAt(surface.tile)->chunk->block(surface.block));
}

Texel texelOf(const Scene& scene, const rays::Surface& surface) {
    const Material& material = scene.parts.blocks->materials()[surface.face.material];
    const Texture& texture = scene.parts.textures[material.texture];
    glm::vec2 at = surface.texel;
    if (surface.tile.level > 0) {
        // A texture covers a block at every level; heights of cells are those of blocks.
        const float width = static_cast<float>(1 << surface.tile.level);
        at.x *= width;
        if (shared::faceDirectionOf(scene.surfaces.shapeFaces[surface.face.shapeFace]) >> 1 == 2)
            at.y *= width;
        at = glm::fract(at);
    }
    const auto index = [&](float v) {
        return std::clamp(static_cast<int>(v * static_cast<float>(texture.side)), 0, texture.side - 1);
    };
    const std::uint8_t* stored =
        &texture.rgba[4 * static_cast<std::size_t>(index(at.y) * texture.side + index(at.x))];
    Texel texel;
    texel.alpha = static_cast<float>(stored[3]) / 255;
    texel.isHole = isHole(material.alpha, texel.alpha);
    if (texel.isHole) return texel;
    texel.glow = glowOf(material.alpha, texel.alpha);
    if (const SceneTile* tile = material.tinted ? scene.tileAt(surface.tile) : nullptr; tile && tile->tint) {
        const float share = material.alpha == AlphaMode::Tint ? texel.alpha : 1;
        const world::PackedColor tint = (*tile->tint)[static_cast<std::size_t>(surface.block & 255)];
        const glm::vec3 color = tinted(glm::vec3(stored[0], stored[1], stored[2]) / 255.0f, tint, share);
        texel.color = {base::decodeSrgb(color.x), base::decodeSrgb(color.y), base::decodeSrgb(color.z)};
    } else {
        const auto& table = decodedBytes();
        texel.color = {table[stored[0]], table[stored[1]], table[stored[2]]};
    }
    return texel;
}

glm::vec3 emittedBy(const Scene& scene, const rays::Surface& surface, const Texel& texel) {
    if (surface.tile.level > 0 || !(surface.isFront || surface.face.isTwoSided)) return glm::vec3(0);
    const world::BlockId id = scene.tileAt(surface.tile)->chunk->block(surface.block);
    if (id >= scene.emission.size() || scene.emission[id] == glm::vec3(0)) return glm::vec3(0);
    const Material& material = scene.parts.blocks->materials()[surface.face.material];
    return scene.emission[id] * emittingShare(material.alpha, texel.alpha);
}

}  // namespace terrane::path
