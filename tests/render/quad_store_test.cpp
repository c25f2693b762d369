#include "terrane/render/quad_store.h"

#include <map>
#include <span>

#include "tests/gpu/gl_fixture.h"

namespace terrane::render {
namespace {

class QuadStoreTest : public gpu::GlTest {};

using world::ChunkPos;

// Quads that tell where they come from. One region.
mesh::ChunkMesh numberedMesh(std::uint32_t seed, std::uint32_t count) {
    mesh::ChunkMesh mesh;
    for (std::uint32_t k = 0; k < count; ++k) mesh.quads.push_back({seed, k});
    mesh.regions.resize(1);
    mesh.regions[0].groups[0][0] = {0, count};
    mesh.regions[0].maxZ = 16;
    return mesh;
}

void expectStored(const QuadStore& store, ChunkPos pos, const mesh::ChunkMesh& mesh) {
    const auto found = store.chunks().find(pos);
    ASSERT_NE(found, store.chunks().end());
    ASSERT_EQ(found->second.count, mesh.quads.size());
    EXPECT_EQ(found->second.regions, mesh.regions);
    std::vector<shared::Quad> stored(mesh.quads.size());
    store.buffer().download(std::size_t{found->second.first} * shared::kQuadBytes,
                            std::as_writable_bytes(std::span(stored)));
    EXPECT_TRUE(stored == mesh.quads);
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
    store.set({0, 0}, mesh::ChunkMesh{{}, std::vector<mesh::RegionMesh>(4)});
    EXPECT_TRUE(store.chunks().empty());
    EXPECT_EQ(store.usedBytes(), 0u);
}

TEST_F(QuadStoreTest, GrowthKeepsTheContents) {
    QuadStore store;
    const std::size_t before = store.buffer().sizeBytes();
    const auto quarter = static_cast<std::uint32_t>(before / shared::kQuadBytes / 4);
    std::vector<mesh::ChunkMesh> meshes;
    for (std::uint32_t k = 0; k < 6; ++k) {
        meshes.push_back(numberedMesh(k, quarter + k));
        store.set({static_cast<int>(k), 0}, meshes.back());
    }
    EXPECT_EQ(store.buffer().sizeBytes(), 2 * before);
    for (std::size_t k = 0; k < meshes.size(); ++k) expectStored(store, {static_cast<int>(k), 0}, meshes[k]);
}

TEST_F(QuadStoreTest, StaysBelowItsLimit) {
    QuadStore store(1000);
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
    EXPECT_LE(store.buffer().sizeBytes(), 1000u * shared::kQuadBytes);
}

// Copies and uploads follow each other in the stream of commands: none gets ahead of the other.
TEST_F(QuadStoreTest, EditsAroundGrowthAreKept) {
    QuadStore store;
    const auto capacity = static_cast<std::uint32_t>(store.buffer().sizeBytes() / shared::kQuadBytes);
    std::map<ChunkPos, mesh::ChunkMesh> expected;
    for (std::uint32_t k = 0; k < 40; ++k) {
        const ChunkPos pos{static_cast<int>(k % 11), 0};
        expected[pos] = numberedMesh(k, capacity / 13 + 1000 * k);
        ASSERT_TRUE(store.set(pos, expected[pos]));
    }
    EXPECT_GT(store.buffer().sizeBytes(), std::size_t{capacity} * shared::kQuadBytes);
    for (const auto& [pos, mesh] : expected) expectStored(store, pos, mesh);
}

// One mesh that is larger than twice the buffer still finds room.
TEST_F(QuadStoreTest, GrowsByWhatIsNeeded) {
    QuadStore store;
    const auto capacity = static_cast<std::uint32_t>(store.buffer().sizeBytes() / shared::kQuadBytes);
    const mesh::ChunkMesh small = numberedMesh(1, 3), large = numberedMesh(2, 2 * capacity + 5);
    store.set({0, 0}, small);
    store.set({1, 0}, large);
    expectStored(store, {0, 0}, small);
    expectStored(store, {1, 0}, large);
}

TEST_F(QuadStoreTest, FreedRoomIsUsedAgain) {
    QuadStore store;
    const std::size_t before = store.buffer().sizeBytes();
    const auto third = static_cast<std::uint32_t>(before / shared::kQuadBytes / 3);
    for (int round = 0; round < 10; ++round) {
        store.set({round % 2, 0}, numberedMesh(static_cast<std::uint32_t>(round), third));
    }
    EXPECT_EQ(store.buffer().sizeBytes(), before);
    expectStored(store, {0, 0}, numberedMesh(8, third));
    expectStored(store, {1, 0}, numberedMesh(9, third));
}

}  // namespace
}  // namespace terrane::render
