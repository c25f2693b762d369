// A box whose six sides have different textures with a letter F, which looks different when rotated or
// mirrored. Its edges differ too: 3 blocks along x, 2 along y, 1 along z.
#pragma once

#include <array>
#include <string>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/frame/renderer.h"

namespace terrane::golden {

constexpr std::array<std::string_view, 6> kSideNames = {"neg_x", "pos_x", "neg_y", "pos_y", "neg_z", "pos_z"};
// Sides of x are red, of y green, of z blue; the positive ones are light.
constexpr std::array<std::array<std::uint8_t, 3>, 6> kSideColors = {
    {{120, 20, 20}, {250, 130, 130}, {20, 100, 20}, {140, 240, 140}, {20, 20, 130}, {140, 140, 255}}};

inline const world::BlockRegistry& cubeBlocks() {
    static const world::BlockRegistry registry = [] {
        std::string toml;
        for (const std::string_view name : kSideNames) {
            toml += "[[block]]\nname = \"" + std::string(name) + "\"\nshape = \"cube\"\ntexture = \"" +
                    std::string(name) + "\"\n";
        }
        auto parsed = world::BlockRegistry::parse(toml, "cube blocks");
        if (!parsed) throw std::runtime_error(parsed.error().message);
        return *std::move(parsed);
    }();
    return registry;
}

inline bool isInLetterF(int x, int y) {
    const bool stem = x >= 4 && x < 7 && y >= 2 && y < 14;
    const bool top = x >= 4 && x < 13 && y >= 2 && y < 5;
    const bool bar = x >= 4 && x < 11 && y >= 7 && y < 10;
    return stem || top || bar;
}

inline base::Result<base::Image> cubeTexture(std::string_view name) {
    std::array<std::uint8_t, 3> color = {255, 0, 255};  // for the block "missing"
    for (std::size_t side = 0; side < kSideNames.size(); ++side) {
        if (kSideNames[side] == name) color = kSideColors[side];
    }
    base::Image image{16, 16, {}};
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const bool isLetter = isInLetterF(x, y);
            for (const std::uint8_t channel : color) image.rgba.push_back(isLetter ? 255 : channel);
            image.rgba.push_back(255);
        }
    }
    return image;
}

constexpr int kCubeX = 6, kCubeY = 7, kCubeZ = 100;  // lowest block

// Without the mesher, so that its errors cannot hide those of the shaders.
inline mesh::ChunkMesh cubeMesh() {
    constexpr std::array<unsigned, 3> kSize = {3, 2, 1};
    mesh::ChunkMesh mesh;
    mesh::MeshSection& meshSection = mesh.meshSections.emplace_back();
    meshSection.bottom = kCubeZ / mesh::kDefaultMeshSectionHeight * mesh::kDefaultMeshSectionHeight;
    meshSection.top = meshSection.bottom + mesh::kDefaultMeshSectionHeight;
    meshSection.minZ = kCubeZ;
    meshSection.maxZ = kCubeZ + 1;
    for (unsigned side = 0; side < 6; ++side) {
        const bool isPositive = side % 2 == 1;
        shared::QuadFields quad{.x = kCubeX, .y = kCubeY, .z = kCubeZ, .shapeFace = side};
        if (isPositive && side / 2 == 0) quad.x += kSize[0] - 1;
        if (isPositive && side / 2 == 1) quad.y += kSize[1] - 1;
        quad.extentU = side / 2 == 0 ? kSize[1] : kSize[0];
        quad.extentV = side / 2 == 2 ? kSize[1] : kSize[2];
        quad.material = cubeBlocks().find(kSideNames[side])->material[side];
        meshSection.ranges[0][side] = {static_cast<std::uint32_t>(mesh.quads.size()), 1};
        mesh.quads.push_back(packQuad(quad));
    }
    return mesh;
}

inline const render::Camera kCubeNegative{{4.3, 3.6, 102.3}, 55, -23, 45};
inline const render::Camera kCubePositive{{11.5, 12.6, 98.2}, 235, 23, 45};

inline render::FrameInput cubeFrame(const render::Camera& camera) {
    return {camera, world::environmentAt(0.5f), 400, 0, render::View::Color};
}

}  // namespace terrane::golden
