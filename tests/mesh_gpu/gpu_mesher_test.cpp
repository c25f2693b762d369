#include "terrane/mesh_gpu/gpu_mesher.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "terrane/mesh/mesh_section_quads.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/mesh/random_blocks.h"
#include "tests/mesh_gpu/mesh_comparison.h"
#include "tests/mesh_gpu/overworld.h"
#include "tests/support/default_heights.h"

namespace terrane::mesh_gpu {
namespace {

using mesh::ChunkMesh;
using mesh::MergeMethod;
using mesh::MeshInput;
using mesh::MeshOptions;

constexpr MergeMethod kMergeMethods[] = {MergeMethod::None, MergeMethod::Lines, MergeMethod::Squares,
                                         MergeMethod::SquaresExt, MergeMethod::Greedy};

class GpuMesherTest : public gpu::GlTest {
  protected:
    GpuBatchMesher mesherOf(const world::BlockRegistry& blocks) {
        auto made = GpuMesher::create(render::contentShaders(), blocks);
        if (!made) throw std::runtime_error(made.error().message);
        return GpuBatchMesher(std::move(*made));
    }
};

void expectEqual(mesh::BatchMesher& mesher, std::span<const MeshInput> chunks) {
    const std::vector<ChunkMesh> found = mesher.mesh(chunks);
    const std::vector<ChunkMesh> expected = mesh::makeCpuMesher()->mesh(chunks);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_EQ(found[k].meshSections.size(), expected[k].meshSections.size());
        for (std::size_t r = 0; r < found[k].meshSections.size(); ++r) {
            ASSERT_TRUE(found[k].meshSections[r] == expected[k].meshSections[r])
                << "chunk " << k << " mesh section " << r;
        }
        ASSERT_TRUE(sorted(found[k]) == sorted(expected[k])) << "chunk " << k;
    }
}

// All block kinds, with and without block state; every height of mesh sections comes up with several mixes.
TEST_F(GpuMesherTest, RandomVolumesEqualCpu) {
    constexpr int kHeights[] = {8, 16, 32, 64, 128};
    GpuBatchMesher mesher = mesherOf(mesh::testBlocks());
    unsigned seed = 300;
    for (int mix = 0; mix < static_cast<int>(mesh::Mix::Count); ++mix) {
        for (const MergeMethod method : kMergeMethods) {
            mesh::Area area(mesh::randomBlocks(static_cast<mesh::Mix>(mix), ++seed));
            if (seed % 2 == 0) area.addBlockState(seed);
            const int height = kHeights[seed % std::size(kHeights)];
            SCOPED_TRACE(fmt::format("mix {} method {} height {}", mix, static_cast<int>(method), height));
            const std::vector<MeshInput> inputs = {area.input({method, height})};
            expectEqual(mesher, inputs);
        }
    }
}

// Worlds of all heights in a batch, also with more mesh sections than the buffers had room for.
TEST_F(GpuMesherTest, AnyHeightsEqualCpu) {
    constexpr world::Heights kTall[] = {
        {-64, 320}, {world::kLowestBottom, -1792}, {1808, world::kHighestTop}, {512, 1024}, {-16, 0}};
    GpuBatchMesher mesher = mesherOf(mesh::testBlocks());
    unsigned seed = 40;
    for (const int height : {8, 16, 128}) {
        std::vector<mesh::Area> areas;
        for (const world::Heights heights : kTall) {
            const auto mix = static_cast<mesh::Mix>(++seed % static_cast<unsigned>(mesh::Mix::Count));
            const mesh::BlockSource source = mesh::randomBlocks(mix, seed);
            areas.emplace_back([&](int x, int y, int z) { return source(x, y, z - heights.bottom); },
                               heights);
            if (seed % 2 == 0) areas.back().addBlockState(seed);
            if (seed % 3 == 0) areas.back().addFlow(seed);
        }
        std::vector<MeshInput> inputs;
        for (const mesh::Area& area : areas) inputs.push_back(area.input({MergeMethod::Greedy, height}));
        SCOPED_TRACE(height);
        expectEqual(mesher, inputs);
    }
    const world::Heights tall{world::kLowestBottom, world::kHighestTop};
    const mesh::Area full(mesh::randomBlocks(mesh::Mix::Slabs, 3), tall);
    const std::vector<MeshInput> inputs(20, full.input({MergeMethod::Lines, 8}));
    expectEqual(mesher, inputs);
}

// A block whose only quad a stone of the next chunk hides has no faces and covers no layer.
TEST_F(GpuMesherTest, HiddenQuadsEqualCpu) {
    GpuBatchMesher mesher = mesherOf(mesh::testBlocks());
    for (const std::vector<mesh::Placed>& more : {std::vector<mesh::Placed>{}, {{8, -1, 40, "stone"}}}) {
        std::vector<mesh::Placed> blocks = more;
        blocks.push_back({8, 0, 40, "poster"});
        const mesh::Area area = mesh::placed(blocks);
        EXPECT_EQ(mesh::meshOf(area).quads.size(), more.empty() ? 1u : 0u);
        const std::vector<MeshInput> inputs = {area.input()};
        expectEqual(mesher, inputs);
    }
}

// Wheat in every stage, also one that stands for none, in all forms of a section.
TEST_F(GpuMesherTest, GrowingPlantsEqualCpu) {
    GpuBatchMesher mesher = mesherOf(mesh::testBlocks());
    std::size_t number = 0;
    for (const unsigned values : {1u, 2u, 4u, 16u, 4096u}) {
        mesh::Area area([](int x, int y, int z) {
            return z < 70 && (x + y + z) % 3 == 0 ? mesh::idOf("wheat") : world::kAir;
        });
        for (int i = 0; i < world::kBlocksPerChunk; ++i) {
            const unsigned hash = shared::hash2(static_cast<unsigned>(i), values, 9);
            area.center.setBlockState(static_cast<world::BlockIndex>(i),
                                      static_cast<std::uint16_t>(hash % values));
        }
        const std::vector<MeshInput> inputs = {area.input({.method = kMergeMethods[number++]})};
        expectEqual(mesher, inputs);
    }
}

// Water and lava in all levels and falling, in all forms of a section, over the borders of chunks.
TEST_F(GpuMesherTest, FlowingLiquidsEqualCpu) {
    GpuBatchMesher mesher = mesherOf(mesh::testBlocks());
    unsigned seed = 900;
    for (const mesh::Mix mix : {mesh::Mix::Terrain, mesh::Mix::Transparent, mesh::Mix::Lumps,
                                mesh::Mix::Slabs, mesh::Mix::Everything}) {
        mesh::Area area(mesh::randomBlocks(mix, ++seed));
        area.addFlow(seed);
        const std::vector<MeshInput> inputs = {area.input({kMergeMethods[seed % 5], seed % 2 == 0 ? 8 : 32})};
        SCOPED_TRACE(fmt::format("mix {}", static_cast<int>(mix)));
        expectEqual(mesher, inputs);
    }
}

TEST_F(GpuMesherTest, EmptyAndFullChunksEqualCpu) {
    GpuBatchMesher mesher = mesherOf(mesh::testBlocks());
    const mesh::Area air([](int, int, int) { return world::kAir; });
    const mesh::Area stone([](int, int, int) { return mesh::idOf("stone"); });
    const mesh::Area water([](int, int, int) { return mesh::idOf("water"); });
    const std::vector<MeshInput> inputs = {air.input(), stone.input(), water.input()};
    expectEqual(mesher, std::span(inputs).first(1));
    expectEqual(mesher, inputs);
}

// More chunks than a batch holds; neighbors are in the batch, in the next one, or in none.
TEST_F(GpuMesherTest, OverworldEqualsCpu) {
    const Overworld world(18);
    GpuBatchMesher mesher = mesherOf(contentBlocks());
    expectEqual(mesher, world.inputs({}));
}

TEST_F(GpuMesherTest, EveryMethodOnTheOverworldEqualsCpu) {
    const Overworld world(5);
    GpuBatchMesher mesher = mesherOf(contentBlocks());
    for (const MergeMethod method : kMergeMethods) {
        SCOPED_TRACE(fmt::format("method {}", static_cast<int>(method)));
        expectEqual(mesher, world.inputs({.method = method}));
    }
}

// Data in the buffer around the places of the mesh sections stays unchanged.
TEST_F(GpuMesherTest, WritesOnlyWhereItIsTold) {
    auto mesher = GpuMesher::create(render::contentShaders(), mesh::testBlocks());
    ASSERT_TRUE(mesher) << mesher.error().message;
    const mesh::Area area(mesh::randomBlocks(mesh::Mix::Terrain, 4));
    const std::vector<MeshInput> inputs = {area.input({MergeMethod::Greedy, 16})};
    mesher->count(inputs);
    const std::vector<mesh::MeshSection> meshSections = mesher->meshSections().all;
    constexpr std::uint32_t kGap = 7;
    std::vector<std::uint32_t> firstQuads;
    std::uint32_t end = kGap;
    for (const mesh::MeshSection& meshSection : meshSections) {
        firstQuads.push_back(end);
        end += mesh::quadCount(meshSection) + kGap;
    }
    constexpr shared::Quad kUntouched{0xDEADBEEF, 0xFFFFFFFF};
    std::vector<shared::Quad> quads(end, kUntouched);
    const gpu::Buffer buffer(std::as_bytes(std::span(quads)), 0, "quads");
    mesher->write(firstQuads, buffer);
    buffer.download(0, std::as_writable_bytes(std::span(quads)));
    std::size_t written = 0;
    for (std::uint32_t at = 0; at < end; ++at) {
        bool isInside = false;
        for (std::size_t r = 0; r < meshSections.size(); ++r) {
            isInside |= at >= firstQuads[r] && at < firstQuads[r] + mesh::quadCount(meshSections[r]);
        }
        ASSERT_EQ(quads[at] == kUntouched, !isInside) << at;
        written += isInside;
    }
    mesh::MeshScratch scratch;
    EXPECT_EQ(written, meshChunk(inputs[0], scratch).quads.size());
}

// As on the way to the screen: room is made in the store that is drawn from, and the shader fills it.
TEST_F(GpuMesherTest, FillsTheStoreThatIsDrawnFrom) {
    auto mesher = GpuMesher::create(render::contentShaders(), mesh::testBlocks());
    ASSERT_TRUE(mesher) << mesher.error().message;
    const mesh::Area first(mesh::randomBlocks(mesh::Mix::Terrain, 5)),
        second(mesh::randomBlocks(mesh::Mix::Slabs, 6));
    render::QuadStore store({.arenaQuads = 400'000, .maxArenas = 1});
    const std::vector<MeshInput> inputs = {first.input(), second.input()};
    mesher->count(inputs);
    const CountedSections counted = mesher->meshSections();
    std::vector<std::uint32_t> firstQuads;
    for (std::size_t k = 0; k < 2; ++k) {
        const world::ChunkPos pos{static_cast<int>(k), 0};
        ASSERT_TRUE(store.reserve(pos, counted.ofChunk(k)));
        for (const mesh::MeshSection& meshSection : store.meshSectionsOf(pos))
            firstQuads.push_back(mesh::firstQuad(meshSection));
    }
    mesher->write(firstQuads, *store.buffers().buffers.front());
    EXPECT_EQ(store.uploadedBytes(), 0u);
    for (std::size_t k = 0; k < 2; ++k) {
        const ChunkMesh stored = meshIn(store, {static_cast<int>(k), 0});
        mesh::MeshScratch scratch;
        EXPECT_TRUE(sorted(stored) == sorted(meshChunk(inputs[k], scratch))) << "chunk " << k;
    }
}

TEST_F(GpuMesherTest, RefusesBatchesItCannotMesh) {
    auto mesher = GpuMesher::create(render::contentShaders(), mesh::testBlocks());
    ASSERT_TRUE(mesher) << mesher.error().message;
    EXPECT_THROW((void)mesher->meshSections(), std::invalid_argument) << "nothing is counted";
    EXPECT_THROW(mesher->count({}), std::invalid_argument);
    const mesh::Area area(mesh::randomBlocks(mesh::Mix::Dense, 1));
    std::vector<MeshInput> chunks(2, area.input({MergeMethod::None, 64}));
    chunks[1].options.meshSectionHeight = 32;
    EXPECT_THROW(mesher->count(chunks), std::invalid_argument) << "two heights";
    chunks[1] = chunks[0];
    chunks[1].neighbors[2] = nullptr;
    EXPECT_THROW(mesher->count(chunks), std::invalid_argument) << "an unknown neighbor";
    chunks.pop_back();
    mesher->count(chunks);
    const gpu::Buffer quads(shared::kQuadBytes, 0, "quads");
    EXPECT_THROW(mesher->write(std::vector<std::uint32_t>(3), quads), std::invalid_argument)
        << "of four mesh sections";
    EXPECT_THROW(mesher->write(std::vector<std::uint32_t>(4), quads), std::invalid_argument) << "no room";
}

}  // namespace
}  // namespace terrane::mesh_gpu
