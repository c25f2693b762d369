#include "terrane/render/frame/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/mesh/remesh.h"
#include "terrane/shared/hash.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

// One block, alone in the world's chunk 0, 0.
mesh::ChunkMesh blockMesh(std::string_view name, int x, int y, int z) {
    world::Chunk chunk;
    chunk.setBlock(world::blockIndex(x, y, z), contentBlock(name));
    return mesh::meshAlone(chunk, contentBlocks());
}

const Camera kLevel{.position = {-4, 8, 100}, .yaw = 0};

TEST_F(RendererTest, AnEmptyWorldIsSky) {
    const base::Image image = draw(noon(kLevel));
    EXPECT_EQ(renderer_->statistics().quads, 0u);
    EXPECT_EQ(renderer_->quadBytes(), 0u);
    for (int x = 0; x < kImageSize.x; ++x) {
        const Color top = pixel(image, x, 0), horizon = pixel(image, x, kImageSize.y / 2 - 1);
        EXPECT_GT(top[2], top[0] + 40) << "the zenith is blue";
        EXPECT_GT(horizon[0], top[0] + 20) << "the horizon is paler";
    }
    for (int y = 1; y < kImageSize.y; ++y) {
        const int step = std::abs(pixel(image, 5, y)[0] - pixel(image, 5, y - 1)[0]);
        EXPECT_LE(step, 12) << "row " << y << " has an edge";
    }
}

TEST_F(RendererTest, AFrameLeavesNoProgramCurrent) {
    draw(noon(kLevel));
    GLint program = -1;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    EXPECT_EQ(program, 0) << "the next clear may check textures that are deleted by then";
}

TEST_F(RendererTest, TheSunStandsWhereItShould) {
    const world::Environment e = world::environmentAt(0.4f);
    const float yaw = std::atan2(e.lightDirection.y, e.lightDirection.x) * 57.29578f;
    const float pitch = std::asin(e.lightDirection.z) * 57.29578f;
    const Camera atSun{.position = {8, 8, 100}, .yaw = yaw, .pitch = pitch, .fieldOfView = 40};
    const base::Image image = draw({atSun, e, 256, 0, View::Color});
    const Color sun = pixel(image, kImageSize.x / 2, kImageSize.y / 2), sky = pixel(image, 2, 2);
    EXPECT_GT(sun[0], 245);
    EXPECT_LT(sky[0], 180);
}

// Width and height of the part of an image that is brighter than the light's middle less a step.
glm::ivec2 sizeOfDisc(const base::Image& image) {
    glm::ivec2 low = kImageSize, high(0);
    for (int y = 0; y < kImageSize.y; ++y) {
        for (int x = 0; x < kImageSize.x; ++x) {
            if (pixel(image, x, y)[2] < 200) continue;
            low = glm::min(low, glm::ivec2(x, y));
            high = glm::max(high, glm::ivec2(x + 1, y + 1));
        }
    }
    return high - low;
}

TEST_F(RendererTest, TheMoonIsRoundAtTheEdgeOfTheImage) {
    world::Environment night = world::environmentAt(0.0f);
    night.discRadius = 0.12f;
    night.discColor = glm::vec3(3);
    const float yaw = std::atan2(night.lightDirection.y, night.lightDirection.x) * 57.29578f;
    const float pitch = std::asin(night.lightDirection.z) * 57.29578f;
    for (const float aside : {0.0f, 32.0f}) {
        const Camera camera{.position = {8, 8, 100}, .yaw = yaw, .pitch = pitch - aside, .fieldOfView = 90};
        const glm::vec2 size(sizeOfDisc(draw({camera, night, 256, 0, View::Color})));
        ASSERT_GT(size.x, 4) << aside;
        EXPECT_NEAR(size.y / size.x, 1, 0.13f) << aside;
    }
}

// Difference in steps between the brightest and the darkest pixel.
int rangeOfGreen(const base::Image& image, glm::ivec2 from, glm::ivec2 to) {
    int least = 255, most = 0;
    for (int y = from.y; y < to.y; ++y) {
        for (int x = from.x; x < to.x; ++x) {
            least = std::min(least, pixel(image, x, y)[1]);
            most = std::max(most, pixel(image, x, y)[1]);
        }
    }
    return most - least;
}

// Clouds are off here.
TEST_F(RendererTest, WithoutCloudsTheNightHasStarsAndTheMoonAFace) {
    const Camera up{.position = {8, 8, 100}, .yaw = 200, .pitch = 50, .fieldOfView = 40};
    const auto rangeAt = [&](float timeDay) {
        return rangeOfGreen(draw({up, world::environmentAt(timeDay), 256, 0, View::Color}), {0, 0},
                            kImageSize);
    };
    EXPECT_GT(rangeAt(0.0f), rangeAt(0.5f) + 20);
    const world::Environment night = world::environmentAt(0.05f);
    const Camera atMoon{.position = {8, 8, 100},
                        .yaw = std::atan2(night.lightDirection.y, night.lightDirection.x) * 57.29578f,
                        .pitch = std::asin(night.lightDirection.z) * 57.29578f,
                        .fieldOfView = 2 * 57.29578f * night.discRadius};
    const base::Image moon = draw({atMoon, night, 256, 0, View::Color});
    EXPECT_GT(rangeOfGreen(moon, kImageSize / 2 - 16, kImageSize / 2 + 16), 20) << "bright and dark plains";
}

TEST_F(RendererTest, DebugViewsOfTheSkyAreBlack) {
    for (const View view : {View::Normal, View::Depth}) {
        const base::Image image = draw(noon(kLevel, view));
        for (int x = 0; x < kImageSize.x; ++x) EXPECT_EQ(pixel(image, x, 30), (Color{0, 0, 0}));
    }
}

TEST_F(RendererTest, ABlockIsSeenFromTheSideItTurnsToTheCamera) {
    renderer_->setChunk({0, 0}, blockMesh("stone", 0, 8, 100));
    struct Case {
        Camera camera;
        Color normal;
    };
    const Case cases[] = {
        {{{-2, 8.5, 100.5}, 0, 0}, {0, 128, 128}}, {{{3, 8.5, 100.5}, 180, 0}, {255, 128, 128}},
        {{{0.5, 6, 100.5}, 90, 0}, {128, 0, 128}}, {{{0.5, 11, 100.5}, -90, 0}, {128, 255, 128}},
        {{{0.5, 8.5, 98}, 0, 90}, {128, 128, 0}},  {{{0.5, 8.5, 103}, 0, -90}, {128, 128, 255}},
    };
    for (const Case& c : cases) {
        const Color normal = pixel(draw(noon(c.camera, View::Normal)), kImageSize.x / 2, kImageSize.y / 2);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(normal[k], c.normal[k], 1);
    }
    EXPECT_EQ(pixel(draw(noon({{-2, 8.5, 100.5}, 180, 0}, View::Normal)), 48, 32), (Color{0, 0, 0}))
        << "the camera looks away";
}

TEST_F(RendererTest, DepthIsTheDistanceToTheFog) {
    renderer_->setChunk({0, 0}, blockMesh("stone", 0, 8, 100));
    FrameInput input = noon({{-8, 8.5, 100.5}, 0, 0, 20}, View::Depth);
    input.fogDistance = 16;
    EXPECT_NEAR(pixel(draw(input), 48, 32)[0], 128, 1) << "half of the way";
    input.fogDistance = 32;
    EXPECT_NEAR(pixel(draw(input), 48, 32)[0], 191, 1);
}

TEST_F(RendererTest, WhatIsNearerHidesWhatIsBehind) {
    renderer_->setChunk({0, 0}, blockMesh("lamp_red", 0, 8, 100));
    renderer_->setChunk({1, 0}, blockMesh("lamp_blue", 0, 8, 100));
    const auto middle = [&](const Camera& camera) { return pixel(draw(noon(camera)), 48, 32); };
    const Color red = middle({{-4, 8.5, 100.5}, 0, 0, 20}), blue = middle({{21, 8.5, 100.5}, 180, 0, 20});
    EXPECT_GT(red[0], red[2] + 60);
    EXPECT_GT(blue[2], blue[0] + 60);
}

TEST_F(RendererTest, FogTurnsEverythingToSky) {
    FrameInput input = noon({{-12, 8.5, 100.5}, 0, 0, 20});
    input.fogDistance = 8;
    const base::Image sky = draw(input);
    renderer_->setChunk({0, 0}, blockMesh("oak_log", 0, 8, 100));
    const base::Image fogged = draw(input);
    EXPECT_GT(renderer_->statistics().quads, 0u);
    for (std::size_t k = 0; k < sky.rgba.size(); ++k) ASSERT_NEAR(sky.rgba[k], fogged.rgba[k], 2);
}

TEST_F(RendererTest, RemovedChunksAreGone) {
    const base::Image before = draw(noon(kLevel));
    renderer_->setChunk({0, 0}, blockMesh("grass", 4, 8, 100));
    const base::Image with = draw(noon(kLevel));
    EXPECT_EQ(renderer_->statistics().meshSections, 1u);
    EXPECT_GT(renderer_->statistics().quads, 0u);
    EXPECT_GT(renderer_->statistics().drawCommands, 0u);
    EXPECT_EQ(renderer_->quadBytes(), 6 * shared::kQuadBytes);
    EXPECT_NE(with.rgba, before.rgba);
    renderer_->removeChunk({0, 0});
    EXPECT_EQ(draw(noon(kLevel)).rgba, before.rgba);
}

// State of one frame must not affect the next, also over more frames than the ring has slices.
TEST_F(RendererTest, FramesDoNotDependOnTheOnesBefore) {
    renderer_->setChunk({0, 0}, blockMesh("stone", 4, 8, 100));
    renderer_->setChunk({1, 0}, blockMesh("oak_leaves", 0, 4, 100));
    renderer_->setChunk({1, 1}, blockMesh("water", 0, 0, 100));
    const Camera close{.position = {2, 8.5, 100.5}};
    const base::Image first = draw(noon(kLevel)), other = draw(noon(close));
    EXPECT_NE(first.rgba, other.rgba);
    for (int frame = 0; frame < 5; ++frame) {
        EXPECT_EQ(draw(noon(kLevel)).rgba, first.rgba) << "frame " << frame;
        EXPECT_EQ(draw(noon(close)).rgba, other.rgba) << "frame " << frame;
    }
}

// A chunk may grow, shrink or vanish: the next frame is that of a renderer that never saw its old mesh.
TEST_F(RendererTest, EditsAreWholeInTheNextFrame) {
    std::vector<mesh::ChunkMesh> meshes;
    std::vector<base::Image> expected;
    for (const std::string_view name : {"stone", "water", "grass_tuft", "oak_leaves", "cactus", "lamp_red"}) {
        meshes.push_back(blockMesh(name, 4, 8, 100));
        renderer_->setChunk({0, 0}, meshes.back());
        expected.push_back(draw(noon(kLevel)));
        renderer_->removeChunk({0, 0});
    }
    for (std::size_t frame = 0; frame < 40; ++frame) {
        const std::size_t shown = frame * frame % meshes.size();
        for (std::size_t passing = 0; passing < frame % 3; ++passing) {
            renderer_->setChunk({0, 0}, meshes[(shown + passing + 1) % meshes.size()]);
        }
        renderer_->setChunk({0, 0}, meshes[shown]);
        renderer_->setChunk({static_cast<int>(frame) - 100, 0}, meshes[frame % meshes.size()]);  // behind
        ASSERT_EQ(draw(noon(kLevel)).rgba, expected[shown].rgba) << "frame " << frame;
    }
}

TEST_F(RendererTest, ResizingChangesTheSizeOnly) {
    renderer_->setChunk({0, 0}, blockMesh("stone", 4, 8, 100));
    const base::Image before = draw(noon(kLevel));
    for (const glm::ivec2 size : {glm::ivec2{1, 1}, {33, 17}, {640, 2}, {7, 300}}) {
        resize(size, 1);
        draw(noon(kLevel));
    }
    resize(kImageSize, 1);
    EXPECT_EQ(draw(noon(kLevel)).rgba, before.rgba);
}

// Samples smooth the edges and change nothing else.
TEST_F(RendererTest, SamplesSmoothEdges) {
    renderer_->setChunk({0, 0}, blockMesh("snow", 0, 8, 100));
    const FrameInput input = noon({{-2, 7.2, 101.3}, 12, -20}, View::Normal);
    const auto shades = [](const base::Image& image) {
        std::set<Color> all;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) all.insert(pixel(image, x, y));
        }
        return all.size();
    };
    const std::size_t plain = shades(draw(input));
    EXPECT_LE(plain, 4u) << "the sky and at most three sides";
    const int most = std::min(8, gpu::queryDevice().maxSamples);
    for (int samples = 2; samples <= most; samples *= 2) {
        resize(kImageSize, samples);
        EXPECT_GT(shades(draw(input)), plain) << samples << " samples";
    }
}

TEST_F(RendererTest, MoreSamplesThanTheDriverHasAreAnError) {
    const int tooMany = 2 * gpu::queryDevice().maxSamples;
    const auto resized = renderer_->configure(kImageSize, plainOptions(tooMany));
    ASSERT_FALSE(resized);
    EXPECT_NE(resized.error().message.find(std::to_string(tooMany)), std::string::npos)
        << resized.error().message;
    EXPECT_EQ(renderer_->size(), kImageSize) << "the old targets stay";
    draw(noon(kLevel));
}

TEST_F(RendererTest, ATextureThatIsMissingIsAnError) {
    const auto none = [](std::string_view name) -> base::Result<base::Image> {
        if (name == "dirt") return base::fail("dirt is lost");
        return contentTexture(name);
    };
    const auto made = Renderer::create(contentShaders(), contentBlocks(), none, gpu::queryDevice());
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().message, "dirt is lost");
}

TEST_F(RendererTest, TexturesOfOtherShapesAreAnError) {
    const auto sized = [](int width, int height) {
        return [=](std::string_view name) -> base::Result<base::Image> {
            if (name != "dirt") return contentTexture(name);
            return base::Image{width, height,
                               std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width * height))};
        };
    };
    for (const auto& [width, height] : {std::pair(16, 8), {12, 12}, {0, 0}}) {
        const auto made = loadBlockTextures(contentBlocks(), sized(width, height), {.layers = 2048});
        ASSERT_FALSE(made);
        EXPECT_NE(made.error().message.find("\"dirt\""), std::string::npos) << made.error().message;
    }
}

TEST_F(RendererTest, LimitedTexturesLoseTheirLargestLevels) {
    const auto sized = [](std::string_view name) -> base::Result<base::Image> {
        const int side = name == "dirt" ? 8 : 64;
        return base::Image{side, side,
                           std::vector<std::uint8_t>(static_cast<std::size_t>(4 * side * side), 200)};
    };
    const auto textures = loadBlockTextures(contentBlocks(), sized, {.layers = 2048, .side = 16});
    ASSERT_TRUE(textures);
    EXPECT_EQ(textures->array.shape().size, glm::ivec2(16));
    EXPECT_EQ(textures->array.shape().levels, 5);
    const auto names = contentBlocks().textures();
    for (std::size_t layer = 0; layer < names.size(); ++layer)
        EXPECT_EQ(textures->doublings[layer], names[layer] == "dirt" ? 1 : 0) << names[layer];
}

// After edits that replace the mesh sections they touch every frame is that of a renderer that got everything
// again, and no more than these mesh sections' quads were uploaded.
TEST_F(RendererTest, EditsOfMeshSectionsLookAsIfAllWasMeshedAgain) {
    constexpr int kLowMeshSection = 16;
    constexpr std::array kNames = {"stone", "water", "oak_leaves", "sand", "grass", "air"};
    world::Chunk chunk;
    const world::Chunk air;
    mesh::MeshInput input;
    input.center = &chunk;
    input.neighbors = {&air, &air, &air, &air};
    input.blocks = &contentBlocks();
    input.options.meshSectionHeight = kLowMeshSection;
    mesh::MeshScratch scratch;
    auto other = Renderer::create(contentShaders(), contentBlocks(), contentTexture, gpu::queryDevice());
    ASSERT_TRUE(other && other->configure(kImageSize, plainOptions(1)));
    const FrameInput frame = noon({.position = {-12, 8, 110}, .yaw = 0, .pitch = -15});
    for (unsigned step = 0; step < 60; ++step) {
        const auto random = [&](unsigned k, unsigned count) {
            return static_cast<int>(shared::hash2(step, k, 31) % count);
        };
        const world::BlockPos pos{random(0, 16), random(1, 16), 85 + random(2, 30)};
        const std::string_view name = kNames[static_cast<std::size_t>(random(3, kNames.size()))];
        chunk.setBlock(world::blockIndex(pos.x, pos.y, pos.z),
                       name == "air" ? world::kAir : contentBlock(name));
        const mesh::MeshSectionSet meshSections = mesh::meshSectionsTouchedBy(pos)[0].meshSections;
        const mesh::ChunkMesh part = buildMeshSections(input, meshSections, scratch);
        const std::uint64_t before = renderer_->uploadedQuadBytes();
        ASSERT_TRUE(renderer_->setChunk({0, 0}, part, meshSections));
        EXPECT_EQ(renderer_->uploadedQuadBytes() - before, part.quads.size() * shared::kQuadBytes);
        ASSERT_TRUE(other->setChunk({0, 0}, meshChunk(input, scratch)));
        other->draw(frame);
        ASSERT_TRUE(draw(frame).rgba == other->readImage().rgba) << step;
    }
    EXPECT_EQ(renderer_->quadBytes(), other->quadBytes());
}

TEST_F(RendererTest, RefusesAFrameWithoutASizeAndChunksThatItCannotPlace) {
    auto fresh = Renderer::create(contentShaders(), contentBlocks(), contentTexture, gpu::queryDevice());
    ASSERT_TRUE(fresh) << fresh.error().message;
    EXPECT_THROW(fresh->draw(noon(kLevel)), std::invalid_argument);
    for (const glm::ivec2 size : {glm::ivec2(0, 0), glm::ivec2(64, 0), glm::ivec2(-1, 64)}) {
        const auto configured = fresh->configure(size, plainOptions(1));
        ASSERT_FALSE(configured);
        EXPECT_EQ(configured.error().code, base::ErrorCode::BadInput);
    }
    EXPECT_THROW(renderer_->setLight({0, 0, 1}, light::ChunkLight()), std::invalid_argument);
    EXPECT_THROW(renderer_->setTint({0, 0}, {}), std::invalid_argument) << "useTint() comes first";
    draw(noon(kLevel));
}

}  // namespace
}  // namespace terrane::render
