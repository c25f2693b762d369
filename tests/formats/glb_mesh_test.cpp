#include "terrane/formats/glb_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "terrane/content/built_in.h"
#include "terrane/mesh/chunk_mesher.h"

namespace terrane::formats {
namespace {

using nlohmann::json;

class GlbMeshTest : public testing::Test {
  protected:
    world::Chunk chunkWith(std::string_view name, std::uint16_t state = 0) const {
        world::Chunk chunk;
        chunk.setBlock(world::blockIndex(3, 5, 7), blocks.find(name)->id);
        chunk.setBlockState(world::blockIndex(3, 5, 7), state);
        return chunk;
    }
    GlbModel modelOf(const world::Chunk& chunk, glm::ivec3 corner = glm::ivec3(0)) const {
        GlbMesh mesh(blocks, textures);
        EXPECT_TRUE(mesh.add(mesh::meshAlone(chunk, blocks), corner));
        auto model = mesh.finish("test");
        EXPECT_TRUE(model) << model.error().message;
        return *model;
    }

    world::BlockRegistry blocks = *content::loadBlocks();
    world::TextureSource textures = content::builtInTextures();
};

TEST_F(GlbMeshTest, OneCubeHasSixFacesOutward) {
    const GlbModel model = modelOf(chunkWith("stone"), {100, 0, 0});
    ASSERT_EQ(model.parts.size(), 1u);
    const GlbPart& part = model.parts[0];
    EXPECT_EQ(part.vertices.size(), 24u);
    EXPECT_EQ(part.indices.size(), 36u);
    EXPECT_EQ(part.alpha, GlbAlpha::Opaque);
    EXPECT_FALSE(part.isTwoSided);
    float volume = 0;
    for (std::size_t k = 0; k < part.indices.size(); k += 3) {
        const auto corner = [&](std::size_t n) { return part.vertices[part.indices[k + n]]; };
        const glm::vec3 a = corner(0).position, b = corner(1).position, c = corner(2).position;
        EXPECT_GT(glm::dot(glm::cross(b - a, c - a), corner(0).normal), 0.9f);
        const glm::vec3 middle(103.5f, 7.5f, -5.5f);
        volume += glm::dot(a - middle, glm::cross(b - middle, c - middle)) / 6;
        // Our 3, 5, 7 is x 3, y 7, z -6 to -5.
        EXPECT_TRUE(a.x >= 103 && a.x <= 104 && a.y >= 7 && a.y <= 8 && a.z >= -6 && a.z <= -5);
    }
    EXPECT_NEAR(volume, 1, 1e-4f);
}

TEST_F(GlbMeshTest, TexturesRepeatOverMergedFaces) {
    world::Chunk chunk = chunkWith("stone");
    chunk.setBlock(world::blockIndex(4, 5, 7), blocks.find("stone")->id);
    const GlbModel model = modelOf(chunk);
    std::set<std::pair<float, float>> uvs;
    for (const GlbVertex& vertex : model.parts[0].vertices)
        if (vertex.normal.y > 0.5f) uvs.insert({vertex.uv.x, vertex.uv.y});
    EXPECT_EQ(uvs, (std::set<std::pair<float, float>>{{0, 0}, {2, 0}, {0, 1}, {2, 1}}));
}

TEST_F(GlbMeshTest, FacesOfModelsShowTheirPartOfTheTexture) {
    const GlbModel model = modelOf(chunkWith("oak_slab"));
    for (const GlbVertex& vertex : model.parts[0].vertices) {
        const bool isSide = std::abs(vertex.normal.y) < 0.5f;
        // The lower half of a texture is below v 0.5.
        if (isSide) {
            EXPECT_EQ(vertex.uv.y, vertex.position.y == 7 ? 1.0f : 0.5f);
        }
        EXPECT_TRUE(vertex.uv.x == 0 || vertex.uv.x == 1);
    }
}

TEST_F(GlbMeshTest, MaterialsFollowAlpha) {
    EXPECT_EQ(modelOf(chunkWith("oak_leaves")).parts[0].alpha, GlbAlpha::Mask);
    EXPECT_TRUE(modelOf(chunkWith("grass_tuft")).parts[0].isTwoSided);
    EXPECT_EQ(modelOf(chunkWith("water")).parts[0].alpha, GlbAlpha::Blend);
    const GlbModel lamp = modelOf(chunkWith("lamp_white"));
    ASSERT_GE(lamp.parts[0].glow, 0);
    EXPECT_EQ(lamp.images.size(), 2u);
    const GlbModel crystal = modelOf(chunkWith("crystal"));
    EXPECT_EQ(crystal.parts[0].alpha, GlbAlpha::Mask);
    ASSERT_GE(crystal.parts[0].glow, 0);
    const auto image = base::decodePng(crystal.images[crystal.parts[0].image].png, "crystal");
    ASSERT_TRUE(image);
    for (std::size_t k = 3; k < image->rgba.size(); k += 4) {
        EXPECT_TRUE(image->rgba[k] == 0 || image->rgba[k] == 255) << "its glow is in the other image";
    }
}

TEST_F(GlbMeshTest, TheFileHoldsTogether) {
    world::Chunk chunk = chunkWith("lamp_red");
    chunk.setBlock(world::blockIndex(0, 0, 0), blocks.find("glass")->id);
    const std::string bytes = *encodeGlb(modelOf(chunk));
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(8), bytes.size());
    const json head = json::parse(bytes.substr(20, word(12)));
    const std::size_t binary = word(20 + word(12));
    EXPECT_EQ(28 + word(12) + binary, bytes.size());
    EXPECT_EQ(head["buffers"][0]["byteLength"], binary);
    for (const json& view : head["bufferViews"]) {
        const std::size_t offset = view["byteOffset"], length = view["byteLength"];
        EXPECT_LE(offset + length, binary);
        EXPECT_EQ(offset % 4, 0u);
    }
    EXPECT_EQ(head["materials"].size(), head["meshes"][0]["primitives"].size());
}

TEST_F(GlbMeshTest, AirIsNoModel) {
    GlbMesh mesh(blocks, textures);
    EXPECT_TRUE(mesh.add(mesh::meshAlone(world::Chunk(), blocks), glm::ivec3(0)));
    EXPECT_FALSE(mesh.finish("nothing"));
}

TEST_F(GlbMeshTest, AModelWithoutTrianglesIsNotEncoded) {
    GlbModel model = modelOf(chunkWith("stone"));
    model.parts.front().indices.clear();
    for (const GlbModel& empty : {GlbModel(), model}) {
        const auto bytes = encodeGlb(empty);
        ASSERT_FALSE(bytes);
        EXPECT_EQ(bytes.error().code, base::ErrorCode::BadInput);
    }
}

}  // namespace
}  // namespace terrane::formats
