// Shading at the corners of quads (Shading::Corners): the image does not depend on how its quads and their
// light came to be.
#include <gtest/gtest.h>

#include "terrane/shared/hash.h"
#include "tests/golden/scenes.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

constexpr glm::ivec2 kCornersSize{160, 90};
const Camera kAboveIt{{-6, -8, 92}, 50, -30};

class CornersTest : public RendererTest {
  protected:
    void SetUp() override {
        RendererTest::SetUp();
        if (IsSkipped()) return;
        world::World world = golden::flatWorld(3);
        golden::placeGallery(world);
        golden::placePool(world);
        meshes_ = golden::meshWorld(world);
    }

    // Slopes of colored light, different for each number.
    static light::ChunkLight lightOf(world::ChunkPos pos, int number) {
        light::ChunkLight light;
        std::array<light::LightValue, world::kBlocksPerSection> values;
        for (int k = 0; k < world::kBlocksPerSection; ++k) {
            const int x = 16 * pos.x + (k & 15), y = 16 * pos.y + (k >> 4 & 15);
            const auto level = [&](int along) { return static_cast<unsigned>(along / (2 + number) & 15); };
            values[static_cast<std::size_t>(k)] =
                static_cast<light::LightValue>(level(x + 60) | level(y + 70) << 8 | level(x + y + 90) << 12);
        }
        const light::LightBrick brick = light::LightBrick::fromValues(values);
        for (int section = 4; section < 7; ++section) light.setBrick(section, brick);
        return light;
    }
    void setLights(int number) {
        for (const auto& [pos, mesh] : meshes_) renderer_->setLight(pos, lightOf(pos, number));
    }
    void setMeshes() {
        for (const auto& [pos, mesh] : meshes_) EXPECT_TRUE(renderer_->setChunk(pos, mesh));
    }
    void shadeAt(Shading shading) {
        RenderOptions options = plainOptions(1);
        options.transparencyLayers = 1;
        options.shading = shading;
        options.draw = DrawMethod::Loop;
        ASSERT_TRUE(renderer_->configure(kCornersSize, options));
    }
    // The second frame: quads of the first are drawn first.
    base::Image image() {
        draw(noon(kAboveIt));
        return draw(noon(kAboveIt));
    }

    golden::Meshes meshes_;
};

TEST_F(CornersTest, LightMayComeBeforeOrAfterQuads) {
    shadeAt(Shading::Corners);
    setLights(0);
    setMeshes();
    const base::Image expected = image();
    renderer_->clearChunks();
    setMeshes();
    const base::Image unlit = image();
    setLights(0);
    EXPECT_EQ(image().rgba, expected.rgba);
    EXPECT_NE(unlit.rgba, expected.rgba);
    setLights(1);
    EXPECT_NE(image().rgba, expected.rgba);
    setLights(0);
    EXPECT_EQ(image().rgba, expected.rgba);
}

TEST_F(CornersTest, OptionsChangeThereAndBack) {
    shadeAt(Shading::Corners);
    setLights(0);
    setMeshes();
    const base::Image corners = image();
    renderer_->clearChunks();
    shadeAt(Shading::Sample);
    setLights(0);
    setMeshes();
    const base::Image samples = image();
    shadeAt(Shading::Corners);
    EXPECT_EQ(image().rgba, corners.rgba);
    shadeAt(Shading::Sample);
    EXPECT_EQ(image().rgba, samples.rgba);
}

// The mesher on the GPU writes quads without light.
TEST_F(CornersTest, QuadsThatAShaderWritesAreLit) {
    shadeAt(Shading::Corners);
    setLights(0);
    setMeshes();
    const base::Image expected = image();
    renderer_->clearChunks();
    setLights(0);
    for (const auto& [pos, mesh] : meshes_) {
        ASSERT_TRUE(renderer_->reserveChunk(pos, mesh.meshSections));
        if (mesh.quads.empty()) continue;
        const std::uint32_t first = mesh::firstQuad(renderer_->meshSectionsOf(pos).front());
        const gpu::Buffer& arena = *renderer_->quadBuffers().buffers.front();
        glNamedBufferSubData(arena.id(), static_cast<GLintptr>(first * shared::kQuadBytes),
                             static_cast<GLsizeiptr>(mesh.quads.size() * shared::kQuadBytes),
                             mesh.quads.data());
    }
    EXPECT_EQ(image().rgba, expected.rgba);
}

TEST_F(CornersTest, ListsAndLoopDrawTheSame) {
    if (!gpu::queryDevice().indirectDraws) GTEST_SKIP() << "1 test skipped: the driver draws no lists";
    shadeAt(Shading::Corners);
    setLights(0);
    setMeshes();
    RenderOptions options = renderer_->options();
    options.tJunctions = TJunctions::Open;
    ASSERT_TRUE(renderer_->configure(kCornersSize, options));
    const base::Image loop = image();
    options.draw = DrawMethod::Indirect;
    ASSERT_TRUE(renderer_->configure(kCornersSize, options));
    EXPECT_EQ(image().rgba, loop.rgba);
}

TEST_F(CornersTest, EditsAndRemovedChunksLeaveWhatIsThere) {
    shadeAt(Shading::Corners);
    setLights(0);
    setMeshes();
    mesh::MeshSectionSet edited;
    edited.add(81 >> 3);
    const world::ChunkPos kept{0, 0};
    const mesh::ChunkMesh& whole = meshes_.at(kept);
    EXPECT_TRUE(renderer_->setChunk(kept, {}, edited));
    const base::Image without = image();
    EXPECT_TRUE(renderer_->setChunk(kept, mesh::withMeshSections({}, whole, edited), edited));
    EXPECT_NE(image().rgba, without.rgba);
    for (const auto& [pos, mesh] : meshes_)
        if (pos != kept) renderer_->removeChunk(pos);
    const base::Image alone = image();
    renderer_->clearChunks();
    renderer_->setLight(kept, lightOf(kept, 0));
    EXPECT_TRUE(renderer_->setChunk(kept, whole));
    EXPECT_EQ(image().rgba, alone.rgba);
}

// The mesher on the GPU finds that nothing is left of a chunk.
TEST_F(CornersTest, AReservedChunkReplacesTheOldOne) {
    shadeAt(Shading::Corners);
    setLights(0);
    setMeshes();
    for (const auto& [pos, mesh] : meshes_) ASSERT_TRUE(renderer_->reserveChunk(pos, {}));
    setLights(1);
    const base::Image reserved = image();
    renderer_->clearChunks();
    EXPECT_EQ(image().rgba, reserved.rgba);
}

TEST_F(CornersTest, AFrameLightsAsManyChunksAsItMay) {
    shadeAt(Shading::Corners);
    setLights(0);
    setMeshes();
    const base::Image before = image();
    setLights(1);
    FrameInput input = noon(kAboveIt);
    input.maxLitChunks = 0;
    draw(input);
    EXPECT_EQ(draw(input).rgba, before.rgba);
    input.maxLitChunks = 1;
    for (std::size_t k = 0; k < meshes_.size(); ++k) draw(input);
    const base::Image after = draw(input);
    EXPECT_EQ(image().rgba, after.rgba);
    EXPECT_NE(after.rgba, before.rgba);
}

// No room: the shading before stays, with its quads.
TEST_F(CornersTest, WithoutMemoryTheShadingBeforeStays) {
    shadeAt(Shading::Sample);
    setMeshes();
    renderer_->setMemoryBudget(renderer_->memory().total());
    setMeshes();
    mesh::ChunkMesh large;
    large.quads.resize(50'000);
    mesh::MeshSection& section = large.meshSections.emplace_back();
    section.top = section.maxZ = 32;
    for (auto& bucket : section.ranges)
        for (mesh::QuadRange& range : bucket) range.first = 50'000;
    section.ranges[0][0] = {0, 50'000};
    int chunks = 0;
    while (chunks < 1'000 && renderer_->setChunk({100 + chunks, 100}, large)) ++chunks;
    ASSERT_LT(chunks, 1'000);
    const base::Image before = image();
    RenderOptions options = renderer_->options();
    options.shading = Shading::Corners;
    const auto configured = renderer_->configure(kCornersSize, options);
    ASSERT_FALSE(configured);
    EXPECT_NE(configured.error().message.find("no room for light"), std::string::npos);
    EXPECT_EQ(renderer_->options().shading, Shading::Sample);
    EXPECT_EQ(image().rgba, before.rgba);
}

}  // namespace
}  // namespace terrane::render
