#include "terrane/mesh/model_faces.h"

#include <gtest/gtest.h>

#include "tests/mesh/mesh_fixture.h"

namespace terrane::mesh {
namespace {

// Two blocks that look the same: one of a box, the other of its six sides as quads.
const world::BlockRegistry& twins() {
    static const world::BlockRegistry registry = *world::BlockRegistry::parse(R"(
[[shape]]
name = "box"
boxes = [[2, 3, 0, 16, 12, 9]]
[[shape]]
name = "quads"
quads = [
    { corners = [[2, 12, 0], [2, 3, 0], [2, 3, 9], [2, 12, 9]] },
    { corners = [[16, 3, 0], [16, 12, 0], [16, 12, 9], [16, 3, 9]] },
    { corners = [[2, 3, 0], [16, 3, 0], [16, 3, 9], [2, 3, 9]], uv = [[2, 16], [16, 16], [16, 7], [2, 7]] },
    { corners = [[16, 12, 0], [2, 12, 0], [2, 12, 9], [16, 12, 9]] },
    { corners = [[2, 12, 0], [16, 12, 0], [16, 3, 0], [2, 3, 0]], texture = "bottom", hidden_by = "-z" },
    { corners = [[2, 3, 9], [16, 3, 9], [16, 12, 9], [2, 12, 9]] },
]
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
[[block]]
name = "box"
shape = "box"
textures = { top = "a", bottom = "b", side = "c" }
opacity = 0
[[block]]
name = "quads"
like = "box"
shape = "quads"
)",
                                                                              "twins");
    return registry;
}

ChunkMesh twinMesh(std::string_view name) {
    world::Chunk chunk;
    const auto put = [&](int x, int y, int z, std::string_view block) {
        chunk.setBlock(world::blockIndex(x, y, z), twins().find(block)->id);
    };
    put(3, 4, 40, name);
    put(8, 4, 40, name);
    put(8, 4, 39, "stone");
    put(12, 4, 40, name);
    put(13, 4, 40, "stone");
    put(15, 15, 255, name);
    return meshAlone(chunk, twins());
}

TEST(ModelFaces, ABoxAndItsSidesAsQuadsHaveTheSameMesh) {
    EXPECT_EQ(twins().modelFaces().size(), 6u) << "they share their faces";
    const ChunkMesh box = twinMesh("box");
    EXPECT_TRUE(box == twinMesh("quads"));
    EXPECT_EQ(box.quads.size(), 4 * 6u - 2 + 2 * 6) << "two sides are hidden by stones";
}

// Quads of a block by themselves.
std::vector<shared::Quad> quadsOf(std::string_view name, std::vector<Placed> more, std::uint16_t state = 0) {
    more.push_back({8, 8, 40, name});
    Area area = placed(more);
    area.center.setBlockState(world::blockIndex(8, 8, 40), state);
    std::vector<shared::Quad> quads = meshOf(area).quads;
    std::erase_if(quads, [](shared::Quad q) { return quadShapeFace(q) < shared::kShapeFaceCount; });
    return quads;
}

TEST(ModelFaces, TheNamedNeighborHidesAQuad) {
    EXPECT_EQ(quadsOf("net", {}).size(), 6u + 2);
    EXPECT_EQ(quadsOf("net", {{8, 8, 41, "stone"}}).size(), 6u + 1) << "two-sided, hidden by name";
    EXPECT_EQ(quadsOf("net", {{8, 8, 41, "glass"}}).size(), 6u + 2) << "only opaque cubes hide";
    EXPECT_EQ(quadsOf("net", {{8, 8, 39, "stone"}}).size(), 5u + 2) << "the bottom of its box";
    EXPECT_EQ(quadsOf("poster", {{8, 7, 40, "stone"}}).size(), 0u);
    EXPECT_EQ(quadsOf("poster", {{8, 7, 40, "stone"}}, 1).size(), 1u) << "turned toward +x";
    EXPECT_EQ(quadsOf("poster", {{9, 8, 40, "stone"}}, 1).size(), 0u);
}

TEST(ModelFaces, ObliqueAndTwoSidedQuadsAreDrawnFromEverywhere) {
    Area area = placed({{8, 8, 40, "roof"}, {2, 2, 40, "net"}});
    const ChunkMesh mesh = meshOf(area);
    const MeshSection& meshSection = mesh.meshSections.front();
    const auto count = [&](AlphaClass alpha, bool twoSided, int direction) {
        return meshSection.ranges[drawBucket(alpha, twoSided)][direction].count;
    };
    EXPECT_EQ(count(AlphaClass::Opaque, false, kAnyDirection), 1u) << "the slope";
    EXPECT_EQ(count(AlphaClass::Opaque, false, world::kFacePosY), 1u);
    EXPECT_EQ(count(AlphaClass::Tested, true, kAnyDirection), 2u) << "a diagonal and the top of the net";
    EXPECT_EQ(count(AlphaClass::Tested, false, world::kFacePosZ), 1u) << "of its box";
}

}  // namespace
}  // namespace terrane::mesh
