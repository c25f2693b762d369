#include "terrane/render/quads/quad_store.h"

#include <map>
#include <span>
#include <stdexcept>

#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/shared/hash.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/mesh/random_blocks.h"

namespace terrane::render {
namespace {

class QuadStoreTest : public gpu::GlTest {};

using world::ChunkPos;

// Quads with unique numbers by chunk. One mesh section of 16 layers.
mesh::ChunkMesh numberedMesh(std::uint32_t seed, std::uint32_t count, int bottom = 0) {
    mesh::ChunkMesh mesh;
    for (std::uint32_t k = 0; k < count; ++k) mesh.quads.push_back({seed, k});
    mesh.meshSections.resize(1);
    mesh.meshSections[0].ranges[0][0] = {0, count};
    mesh.meshSections[0].bottom = mesh.meshSections[0].minZ = bottom;
    mesh.meshSections[0].top = mesh.meshSections[0].maxZ = bottom + 16;
    return mesh;
}

// A chunk's content in the store, read back as a mesh.
mesh::ChunkMesh readBack(const QuadStore& store, ChunkPos pos) {
    mesh::ChunkMesh mesh;
    for (const mesh::MeshSection& meshSection : store.meshSectionsOf(pos)) {
        const std::size_t first = mesh.quads.size();
        mesh.quads.resize(first + mesh::quadCount(meshSection));
        mesh.meshSections.push_back(mesh::movedTo(static_cast<std::uint32_t>(first), meshSection));
        const std::uint32_t address = mesh::firstQuad(meshSection);
        store.buffers().buffers[store.ranges().arenaOf(address)]->download(
            std::size_t{store.ranges().offsetOf(address)} * shared::kQuadBytes,
            std::as_writable_bytes(std::span(mesh.quads).subspan(first)));
    }
    return mesh;
}

void expectStored(const QuadStore& store, ChunkPos pos, const mesh::ChunkMesh& mesh) {
    EXPECT_TRUE(readBack(store, pos) == mesh);
}

TEST_F(QuadStoreTest, StartsEmpty) {
    const QuadStore store;
    EXPECT_TRUE(store.chunks().empty());
    EXPECT_EQ(store.usedBytes(), 0u);
}

TEST_F(QuadStoreTest, HoldsWhatWasSet) {
    QuadStore store;
    const mesh::ChunkMesh a = numberedMesh(1, 1000), b = numberedMesh(2, 7);
    store.set({0, 0}, a);
    store.set({-5, 9}, b);
    expectStored(store, {0, 0}, a);
    expectStored(store, {-5, 9}, b);
    EXPECT_EQ(store.usedBytes(), 1007u * shared::kQuadBytes);
}

TEST_F(QuadStoreTest, ReplacesAndRemoves) {
    QuadStore store;
    store.set({0, 0}, numberedMesh(1, 1000));
    store.set({1, 0}, numberedMesh(2, 500));
    const mesh::ChunkMesh newer = numberedMesh(3, 20);
    store.set({0, 0}, newer);
    expectStored(store, {0, 0}, newer);
    expectStored(store, {1, 0}, numberedMesh(2, 500));
    EXPECT_EQ(store.usedBytes(), 520u * shared::kQuadBytes);
    store.remove({0, 0});
    store.remove({0, 0});
    store.remove({77, 77});
    EXPECT_FALSE(store.chunks().contains({0, 0}));
    EXPECT_EQ(store.usedBytes(), 500u * shared::kQuadBytes);
}

TEST_F(QuadStoreTest, EmptyMeshesTakeNothing) {
    QuadStore store;
    store.set({0, 0}, numberedMesh(1, 10));
    store.set({0, 0}, mesh::ChunkMesh{{}, std::vector<mesh::MeshSection>(4)});
    EXPECT_TRUE(store.chunks().empty());
    EXPECT_EQ(store.usedBytes(), 0u);
}

TEST_F(QuadStoreTest, GrowthKeepsTheContents) {
    QuadStore store;
    const std::size_t before = store.bufferBytes();
    const auto quarter = static_cast<std::uint32_t>(before / shared::kQuadBytes / 4);
    std::vector<mesh::ChunkMesh> meshes;
    for (std::uint32_t k = 0; k < 6; ++k) {
        meshes.push_back(numberedMesh(k, quarter + k));
        store.set({static_cast<int>(k), 0}, meshes.back());
    }
    EXPECT_EQ(store.bufferBytes(), 2 * before);
    for (std::size_t k = 0; k < meshes.size(); ++k) expectStored(store, {static_cast<int>(k), 0}, meshes[k]);
}

TEST_F(QuadStoreTest, StaysBelowItsLimit) {
    QuadStore store({.arenaQuads = 1000, .maxArenas = 1});
    const mesh::ChunkMesh a = numberedMesh(1, 600), b = numberedMesh(2, 300), c = numberedMesh(3, 200);
    EXPECT_TRUE(store.set({0, 0}, a));
    EXPECT_TRUE(store.set({1, 0}, b));
    EXPECT_FALSE(store.set({2, 0}, c));
    EXPECT_FALSE(store.chunks().contains({2, 0}));
    EXPECT_FALSE(store.set({1, 0}, numberedMesh(4, 500)));
    EXPECT_FALSE(store.chunks().contains({1, 0})) << "what it was is wrong now";
    EXPECT_TRUE(store.set({2, 0}, c));
    expectStored(store, {0, 0}, a);
    expectStored(store, {2, 0}, c);
    EXPECT_LE(store.bufferBytes(), 1000u * shared::kQuadBytes);
}

// Copies and uploads follow each other in the stream of commands: none gets ahead of the other.
TEST_F(QuadStoreTest, EditsAroundGrowthAreKept) {
    QuadStore store;
    const auto capacity = static_cast<std::uint32_t>(store.bufferBytes() / shared::kQuadBytes);
    std::map<ChunkPos, mesh::ChunkMesh> expected;
    for (std::uint32_t k = 0; k < 40; ++k) {
        const ChunkPos pos{static_cast<int>(k % 11), 0};
        expected[pos] = numberedMesh(k, capacity / 13 + 1000 * k);
        ASSERT_TRUE(store.set(pos, expected[pos]));
    }
    EXPECT_GT(store.bufferBytes(), std::size_t{capacity} * shared::kQuadBytes);
    for (const auto& [pos, mesh] : expected) expectStored(store, pos, mesh);
}

// One mesh that is larger than twice the buffer still finds room.
TEST_F(QuadStoreTest, GrowsByWhatIsNeeded) {
    QuadStore store;
    const auto capacity = static_cast<std::uint32_t>(store.bufferBytes() / shared::kQuadBytes);
    const mesh::ChunkMesh small = numberedMesh(1, 3), large = numberedMesh(2, 2 * capacity + 5);
    store.set({0, 0}, small);
    store.set({1, 0}, large);
    expectStored(store, {0, 0}, small);
    expectStored(store, {1, 0}, large);
}

TEST_F(QuadStoreTest, FreedRoomIsUsedAgain) {
    QuadStore store;
    const std::size_t before = store.bufferBytes();
    const auto third = static_cast<std::uint32_t>(before / shared::kQuadBytes / 3);
    for (int round = 0; round < 10; ++round) {
        store.set({round % 2, 0}, numberedMesh(static_cast<std::uint32_t>(round), third));
    }
    EXPECT_EQ(store.bufferBytes(), before);
    expectStored(store, {0, 0}, numberedMesh(8, third));
    expectStored(store, {1, 0}, numberedMesh(9, third));
}

// After random edits, each of which replaces the mesh sections it touches, the store holds what meshing all
// again gives; only the mesh sections' quads were uploaded, and nothing leaks.
TEST_F(QuadStoreTest, EditsReplaceOnlyTheirMeshSections) {
    for (const int height : {8, 64}) {
        const mesh::MeshOptions options{mesh::MergeMethod::Greedy, height};
        mesh::Area area(mesh::randomBlocks(mesh::Mix::Terrain, 21));
        mesh::MeshScratch scratch;
        QuadStore store;
        store.set({9, 9}, numberedMesh(1, 100));
        ASSERT_TRUE(store.set({0, 0}, meshChunk(area.input(options), scratch)));
        const std::uint64_t atFirst = store.uploadedBytes();
        std::uint64_t allBytes = 0;
        for (unsigned step = 0; step < 100; ++step) {
            const auto random = [&](unsigned k, unsigned count) {
                return static_cast<int>(shared::hash2(step, k, 8) % count);
            };
            const world::BlockPos pos{random(0, 16), random(1, 16), 30 + random(2, 40)};
            area.center.setBlock(world::blockIndex(pos.x, pos.y, pos.z),
                                 mesh::anyId(shared::hash2(step, 3, 8)));
            const mesh::MeshSectionSet meshSections = mesh::meshSectionsTouchedBy(pos)[0].meshSections;
            const mesh::ChunkMesh part = buildMeshSections(area.input(options), meshSections, scratch);
            const std::uint64_t before = store.uploadedBytes();
            ASSERT_TRUE(store.set({0, 0}, part, meshSections));
            EXPECT_EQ(store.uploadedBytes() - before, part.quads.size() * shared::kQuadBytes);
            const mesh::ChunkMesh all = meshChunk(area.input(options), scratch);
            allBytes += all.quads.size() * shared::kQuadBytes;
            ASSERT_TRUE(readBack(store, {0, 0}) == all) << step;
            ASSERT_EQ(store.usedBytes(), (100 + all.quads.size()) * shared::kQuadBytes);
        }
        if (height == 8) {
            EXPECT_LT(2 * (store.uploadedBytes() - atFirst), allBytes);
        }
        expectStored(store, {9, 9}, numberedMesh(1, 100));
        store.remove({0, 0});
        EXPECT_EQ(store.usedBytes(), 100u * shared::kQuadBytes);
    }
}

// Another height of mesh sections replaces all of them.
TEST_F(QuadStoreTest, AnotherNumberOfMeshSections) {
    const mesh::Area area(mesh::randomBlocks(mesh::Mix::Terrain, 22));
    mesh::MeshScratch scratch;
    QuadStore store;
    for (const int height : {64, 16, 128}) {
        const mesh::ChunkMesh mesh = meshChunk(area.input({mesh::MergeMethod::Greedy, height}), scratch);
        ASSERT_TRUE(store.set({0, 0}, mesh));
        expectStored(store, {0, 0}, mesh);
        EXPECT_EQ(store.usedBytes(), mesh.quads.size() * shared::kQuadBytes);
    }
}

// Random chunks come, change and go in one arena and in many: both hold the same.
TEST_F(QuadStoreTest, ManyArenasHoldWhatOneHolds) {
    QuadStore one, many({.arenaQuads = 300, .maxArenas = 32});
    std::map<ChunkPos, mesh::ChunkMesh> expected;
    for (std::uint32_t step = 0; step < 600; ++step) {
        const std::uint32_t random = shared::hash2(step, 1, 4);
        const ChunkPos pos{static_cast<int>(random % 37), 0};
        if (random / 64 % 3 == 0) {
            one.remove(pos);
            many.remove(pos);
            expected.erase(pos);
        } else {
            expected[pos] = numberedMesh(step, random / 256 % 200 + 1);
            ASSERT_TRUE(one.set(pos, expected[pos]));
            ASSERT_TRUE(many.set(pos, expected[pos]));
        }
        ASSERT_EQ(many.usedBytes(), one.usedBytes());
    }
    EXPECT_EQ(one.buffers().buffers.size(), 1u);
    EXPECT_GT(many.buffers().buffers.size(), 8u);
    for (const auto& [pos, mesh] : expected) {
        expectStored(one, pos, mesh);
        expectStored(many, pos, mesh);
    }
}

// The copy of a doubling counts.
TEST_F(QuadStoreTest, NeverPassesItsBudget) {
    for (const std::size_t maxBytes : {9u << 20, 17u << 20, 20u << 20, 25u << 20, 40u << 20}) {
        QuadStore store;
        store.setMaxBytes(maxBytes);
        int chunks = 0;
        while (store.set({chunks, 0}, numberedMesh(static_cast<std::uint32_t>(chunks), 50'000))) {
            ++chunks;
            ASSERT_LE(store.takePeakBytes(), maxBytes);
        }
        EXPECT_GT(store.usedBytes(), maxBytes / 2) << "most of it is of use";
        for (int k = 0; k < chunks; k += 7)
            expectStored(store, {k, 0}, numberedMesh(static_cast<std::uint32_t>(k), 50'000));
    }
}

TEST_F(QuadStoreTest, AMeshSectionThatFindsNoRoomIsEmpty) {
    QuadStore store({.arenaQuads = 100, .maxArenas = 1});
    const mesh::ChunkMesh lower = numberedMesh(1, 60);
    ASSERT_TRUE(store.set({0, 0}, lower));
    EXPECT_FALSE(store.set({0, 0}, numberedMesh(2, 50, 16), mesh::MeshSectionSet::all({16, 32})));
    expectStored(store, {0, 0}, lower);
    EXPECT_TRUE(store.set({0, 0}, numberedMesh(2, 40, 16), mesh::MeshSectionSet::all({16, 32})));
    EXPECT_FALSE(store.set({0, 0}, numberedMesh(2, 41, 16), mesh::MeshSectionSet::all({16, 32})));
    expectStored(store, {0, 0}, lower);
}

// Mesh sections come in any order; they are in that of their heights.
TEST_F(QuadStoreTest, MeshSectionsOfAnyHeights) {
    QuadStore store;
    for (const int bottom : {2032, -2048, 16, -16, 0}) {
        const world::Heights heights{bottom, bottom + 16};
        ASSERT_TRUE(store.set({0, 0}, numberedMesh(3, 10, bottom), mesh::MeshSectionSet::all(heights)));
    }
    const auto stored = store.meshSectionsOf({0, 0});
    ASSERT_EQ(stored.size(), 5u);
    EXPECT_TRUE(std::ranges::is_sorted(stored, {}, &mesh::MeshSection::bottom));
    EXPECT_EQ(store.usedBytes(), 50u * shared::kQuadBytes);
    ASSERT_TRUE(store.set({0, 0}, {}, mesh::MeshSectionSet::all({-2048, 0})));
    EXPECT_EQ(store.meshSectionsOf({0, 0}).front().bottom, 0);
    EXPECT_EQ(store.usedBytes(), 30u * shared::kQuadBytes);
    ASSERT_TRUE(store.set({0, 0}, {}));
    EXPECT_TRUE(store.chunks().empty());
}

TEST_F(QuadStoreTest, MeshSectionsNameEachQuadOnce) {
    QuadStore store;
    mesh::ChunkMesh mesh = numberedMesh(1, 9);
    mesh.quads.pop_back();
    EXPECT_THROW(store.set({0, 0}, mesh), std::invalid_argument);
    EXPECT_THROW(store.set({0, 0}, numberedMesh(1, 9), mesh::MeshSectionSet::all({16, 32})),
                 std::invalid_argument)
        << "quads of another mesh section";
    EXPECT_TRUE(store.chunks().empty());
}

// Refused mesh sections have no quads, and others stay.
TEST_F(QuadStoreTest, ListsOfDrawsHaveLimits) {
    for (const DrawLimits limits : {DrawLimits{.meshSections = 3}, DrawLimits{.commands = 3}}) {
        QuadStore store({.limits = limits});
        for (int k = 0; k < 3; ++k) EXPECT_TRUE(store.set({k, 0}, numberedMesh(1, 10)));
        EXPECT_FALSE(store.set({3, 0}, numberedMesh(1, 10)));
        EXPECT_TRUE(store.meshSectionsOf({3, 0}).empty());
        EXPECT_TRUE(store.set({4, 0}, numberedMesh(1, 0))) << "nothing takes nothing";
        EXPECT_TRUE(store.set({1, 0}, numberedMesh(2, 20))) << "in place of the old one";
        expectStored(store, {1, 0}, numberedMesh(2, 20));
        store.remove({0, 0});
        EXPECT_TRUE(store.set({3, 0}, numberedMesh(3, 10)));
        EXPECT_FALSE(store.reserve({0, 0}, numberedMesh(3, 10).meshSections));
        EXPECT_EQ(store.usedBytes(), 40u * shared::kQuadBytes);
    }
}

TEST_F(QuadStoreTest, LongMeshSectionsTakeSeveralCommands) {
    QuadStore store({.limits = {.commands = 3}});
    EXPECT_TRUE(store.set({0, 0}, numberedMesh(1, shared::kMaxQuadsPerCommand)));  // a command more than used
    EXPECT_FALSE(store.set({1, 0}, numberedMesh(1, shared::kMaxQuadsPerCommand)));
    EXPECT_TRUE(store.set({1, 0}, numberedMesh(1, 1)));
}

}  // namespace
}  // namespace terrane::render
