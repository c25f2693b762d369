// Chunks of higher levels, whose columns are wider.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "terrane/mesh/remesh.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

class ChunkLevel : public RendererTest {};

// Steps, a tower and a pit, in columns of a chunk.
int heightOf(int x, int y) {
    if (x == 11 && y == 4) return 40;
    return x > 6 && y > 8 ? 8 : 16 + (x + y) / 3;
}

// Part cx, cy of a landscape in which each column of heightOf is `width` blocks wide, surrounded by air
// except where the landscape continues.
mesh::ChunkMesh expandedMesh(int cx, int cy, int width) {
    const auto chunkAt = [&](int chunkX, int chunkY) {
        auto chunk = std::make_shared<world::Chunk>();
        if (std::min(chunkX, chunkY) < 0 || std::max(chunkX, chunkY) >= width) return chunk;
        for (int k = 0; k < world::kChunkSize * world::kChunkSize; ++k) {
            const int x = k % world::kChunkSize, y = k / world::kChunkSize;
            const int height =
                heightOf((world::kChunkSize * chunkX + x) / width, (world::kChunkSize * chunkY + y) / width);
            for (int z = 0; z < height; ++z) {
                chunk->setBlock(world::blockIndex(x, y, z), contentBlock(z % 5 == 0 ? "stone" : "dirt"));
            }
        }
        return chunk;
    };
    const mesh::MeshBlocks blocks{chunkAt(cx, cy), chunkAt(cx - 1, cy), chunkAt(cx + 1, cy),
                                  chunkAt(cx, cy - 1), chunkAt(cx, cy + 1)};
    mesh::MeshScratch scratch;
    return mesh::meshChunk(mesh::meshInput(blocks, contentBlocks(), {}), scratch);
}

// Share of pixels with a component that differs by more than `limit`.
double shareThatDiffers(const base::Image& a, const base::Image& b, int limit) {
    int count = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const Color p = pixel(a, x, y), q = pixel(b, x, y);
            bool differs = false;
            for (std::size_t c = 0; c < 3; ++c) differs = differs || std::abs(p[c] - q[c]) > limit;
            count += differs;
        }
    }
    return static_cast<double>(count) / (a.width * a.height);
}

// One chunk of level 2 equals 4 × 4 chunks of level 0 that repeat each of its columns 4 × 4 times.
TEST_F(ChunkLevel, AChunkOfLevelTwoCoversFourTimesAsMuch) {
    constexpr int kWidth = 4;
    const glm::dvec3 corner(-64, 64, 0);  // of chunk -1, 1 of level 2
    const Camera cameras[] = {{corner + glm::dvec3(-30, -20, 60), 45, -25},
                              {corner + glm::dvec3(32, 32, 90), 0, -89},
                              {corner + glm::dvec3(50, 50, 20), 220, 10},
                              {corner + glm::dvec3(100, 30, 30), 175, -10}};
    resize({192, 128}, 1);
    const auto drawAll = [&](View view) {
        std::vector<base::Image> images;
        for (const Camera& camera : cameras) images.push_back(draw(noon(camera, view)));
        return images;
    };
    constexpr View kViews[] = {View::Depth, View::Normal, View::Color};
    std::vector<std::vector<base::Image>> fine;
    for (int k = 0; k < kWidth * kWidth; ++k) {
        const int cx = k % kWidth, cy = k / kWidth;
        ASSERT_TRUE(renderer_->setChunk({-kWidth + cx, kWidth + cy}, expandedMesh(cx, cy, kWidth)));
    }
    for (const View view : kViews) fine.push_back(drawAll(view));
    for (int k = 0; k < kWidth * kWidth; ++k)
        renderer_->removeChunk({-kWidth + k % kWidth, kWidth + k / kWidth});
    EXPECT_EQ(renderer_->quadBytes(), 0u);
    ASSERT_TRUE(renderer_->setChunk({-1, 1, 2}, expandedMesh(0, 0, 1)));
    for (std::size_t v = 0; v < std::size(kViews); ++v) {
        const std::vector<base::Image> coarse = drawAll(kViews[v]);
        for (std::size_t k = 0; k < coarse.size(); ++k) {
            EXPECT_LT(shareThatDiffers(fine[v][k], coarse[k], 8), 0.004) << "view " << v << ", camera " << k;
        }
    }
    renderer_->removeChunk({-1, 1, 2});
    const base::Image sky = draw(noon(cameras[0], View::Depth));
    EXPECT_GT(shareThatDiffers(fine[0][0], sky, 8), 0.1) << "it covers much of the image";
}

}  // namespace
}  // namespace terrane::render
