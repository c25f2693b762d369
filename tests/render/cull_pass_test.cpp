#include "terrane/render/cull/cull_pass.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "terrane/mesh/mesh_section_quads.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"

namespace terrane::render {
namespace {

constexpr int kOpaque = mesh::drawBucket(mesh::AlphaClass::Opaque, false);
constexpr int kTestedTwoSided = mesh::drawBucket(mesh::AlphaClass::Tested, true);
constexpr int kBlended = mesh::drawBucket(mesh::AlphaClass::Blended, true);
constexpr int kMeshSectionHeight = 64;

// Number of quads of a draw bucket, face direction and mesh section in a test mesh.
struct Part {
    int meshSection, bucket, direction;
    std::uint32_t count;
};

// Parts by mesh section, draw bucket, direction, as the mesher orders them. Mesh sections are full height.
mesh::ChunkMesh meshOfParts(const std::vector<Part>& parts) {
    mesh::ChunkMesh mesh;
    mesh.meshSections.resize(256 / kMeshSectionHeight);
    for (std::size_t r = 0; r < mesh.meshSections.size(); ++r) {
        mesh.meshSections[r].bottom = static_cast<int>(r) * kMeshSectionHeight;
        mesh.meshSections[r].top = mesh.meshSections[r].bottom + kMeshSectionHeight;
        for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
            for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
                mesh::QuadRange range{static_cast<std::uint32_t>(mesh.quads.size()), 0};
                for (const Part& part : parts) {
                    if (part.meshSection != static_cast<int>(r) || part.bucket != bucket ||
                        part.direction != direction)
                        continue;
                    range.count = part.count;
                    mesh.quads.resize(mesh.quads.size() + part.count);
                    mesh.meshSections[r].minZ = mesh.meshSections[r].bottom;
                    mesh.meshSections[r].maxZ = mesh.meshSections[r].top;
                }
                mesh.meshSections[r].ranges[bucket][direction] = range;
            }
        }
    }
    return mesh;
}

// The selection of the GPU, read back.
struct Drawn {
    std::array<std::vector<CullPass::Draw>, mesh::kDrawBucketCount> commands;
    std::size_t quadCount = 0, meshSectionCount = 0;
};

class CullPassTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        clear();
        auto pass = CullPass::create(contentShaders(), gpu::queryDevice());
        ASSERT_TRUE(pass) << pass.error().message;
        pass_.emplace(std::move(*pass));
        ring_.emplace(65536, "test");
    }
    void TearDown() override {
        pass_.reset();
        ring_.reset();
        meshSections_.reset();
        quads_.reset();
        GlTest::TearDown();
    }

    void clear() {
        quads_.emplace();
        meshSections_.emplace();
    }
    void set(world::ChunkPos pos, const mesh::ChunkMesh& mesh) {
        ASSERT_TRUE(quads_->set(pos, mesh));
        meshSections_->set(pos, quads_->meshSectionsOf(pos));
    }

    Drawn& build(const Camera& camera) {
        const ViewMatrices view = viewMatrices(camera, 1.0f);
        meshSections_->update(cameraChunk(camera));
        ring_->beginFrame();
        pass_->run(CullPhase::All, {cameraChunk(camera), view.cameraPosition, frustumOf(view.viewProjection)},
                   *meshSections_, *ring_);
        pass_->endFrame();
        ring_->endFrame();
        glFinish();
        const shared::DrawCounts& counts = pass_->counts();
        list_ = {};
        list_.meshSectionCount = counts.meshSections;
        for (shared::uint list = 0; list < shared::kDrawLists; ++list) {
            list_.commands[list] = pass_->readDraws(list);
            EXPECT_EQ(counts.commands[list], list_.commands[list].size());
            list_.quadCount += counts.quads[list];
        }
        return list_;
    }

    // Numbers of the quads drawn in a draw bucket, by place in the buffer; none may be drawn twice.
    std::set<std::uint32_t> drawn(int bucket) const {
        std::set<std::uint32_t> numbers, instances;
        for (const auto& [command, record] : list_.commands[static_cast<std::size_t>(bucket)]) {
            EXPECT_EQ(command.instanceCount, 1u);
            EXPECT_EQ(command.firstIndex, 0u);
            EXPECT_EQ(command.indexCount % 6, 0u);
            EXPECT_LE(command.indexCount, 6 * shared::kMaxQuadsPerCommand);
            EXPECT_TRUE(instances.insert(command.baseInstance).second) << "each has its record";
            for (std::uint32_t k = 0; k < command.indexCount / 6; ++k) {
                EXPECT_TRUE(numbers.insert(record.firstQuad + k).second);
            }
        }
        return numbers;
    }

    std::set<std::uint32_t> stored(world::ChunkPos pos, int meshSection, int bucket, int direction) const {
        std::set<std::uint32_t> numbers;
        const auto all = quads_->meshSectionsOf(pos);
        const auto found =
            std::ranges::find(all, meshSection * kMeshSectionHeight, &mesh::MeshSection::bottom);
        if (found == all.end()) return numbers;
        const mesh::QuadRange range = found->ranges[bucket][direction];
        for (std::uint32_t k = 0; k < range.count; ++k) numbers.insert(range.first + k);
        return numbers;
    }

    std::optional<QuadStore> quads_;
    std::optional<MeshSectionTable> meshSections_;
    std::optional<CullPass> pass_;
    std::optional<gpu::MappedRing> ring_;
    Drawn list_;
};

TEST_F(CullPassTest, NothingGivesNoCommands) {
    const Drawn& list = build({});
    for (const auto& commands : list.commands) EXPECT_TRUE(commands.empty());
    EXPECT_EQ(list.quadCount + list.meshSectionCount, 0u);
}

TEST_F(CullPassTest, MeshSectionsBehindTheCameraAreCulled) {
    const mesh::ChunkMesh mesh = meshOfParts({{1, kOpaque, mesh::kAnyDirection, 5}});
    set({3, 0}, mesh);
    set({-3, 0}, mesh);
    const Drawn& list = build({.position = {8, 8, 100}, .yaw = 0});
    EXPECT_EQ(list.meshSectionCount, 1u);
    EXPECT_EQ(list.quadCount, 5u);
    EXPECT_EQ(drawn(kOpaque), stored({3, 0}, 1, kOpaque, mesh::kAnyDirection));
    build({.position = {8, 8, 100}, .yaw = 180});
    EXPECT_EQ(drawn(kOpaque), stored({-3, 0}, 1, kOpaque, mesh::kAnyDirection));
}

TEST_F(CullPassTest, MeshSectionsAboveAndBelowTheViewAreCulled) {
    set({3, 0}, meshOfParts({{0, kOpaque, 6, 1}, {1, kOpaque, 6, 2}, {3, kOpaque, 6, 4}}));
    build({.position = {8, 8, 96}, .fieldOfView = 30});
    EXPECT_EQ(drawn(kOpaque), stored({3, 0}, 1, kOpaque, 6));
}

// Camera and chunk may lie at the ends of the world.
TEST_F(CullPassTest, TheEndsOfTheWorldAreLikeItsMiddle) {
    const world::ChunkPos far{world::kMaxChunk, world::kMinChunk};
    set(far, meshOfParts({{1, kOpaque, mesh::kAnyDirection, 1}}));
    const glm::dvec3 corner(16.0 * far.x, 16.0 * far.y, 0);
    EXPECT_EQ(build({.position = corner + glm::dvec3(-20, 8, 100)}).meshSectionCount, 1u);
    EXPECT_EQ(build({.position = corner + glm::dvec3(-20, 8, 100), .yaw = 180}).meshSectionCount, 0u);
    EXPECT_EQ(build({.position = {-2147483640.0, 8, 100}}).meshSectionCount, 1u)
        << "far ahead, without overflow";
}

TEST_F(CullPassTest, DirectionsThatLookAwayAreNotDrawn) {
    std::vector<Part> parts;
    for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction)
        parts.push_back({1, kOpaque, direction, 10});
    set({0, 0}, meshOfParts(parts));
    struct Case {
        Camera camera;
        std::set<int> hidden;
    };
    // Around a box of 16 × 16 blocks at heights 64 to 128.
    const Case cases[] = {
        {{{-20, 8, 100}, 0, 0}, {world::kFacePosX}},
        {{{40, 8, 100}, 180, 0}, {world::kFaceNegX}},
        {{{8, -20, 100}, 90, 0}, {world::kFacePosY}},
        {{{8, 40, 100}, -90, 0}, {world::kFaceNegY}},
        {{{8, 8, 200}, 0, -90}, {world::kFaceNegZ}},
        {{{8, 8, 20}, 0, 90}, {world::kFacePosZ}},
        {{{-20, -20, 200}, 45, -50}, {world::kFacePosX, world::kFacePosY, world::kFaceNegZ}},
        {{{8, 8, 100}, 0, 0}, {}},
    };
    for (const Case& c : cases) {
        build(c.camera);
        std::set<std::uint32_t> expected;
        for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
            if (!c.hidden.contains(direction)) expected.merge(stored({0, 0}, 1, kOpaque, direction));
        }
        EXPECT_EQ(drawn(kOpaque), expected);
        EXPECT_EQ(list_.quadCount, expected.size());
    }
}

TEST_F(CullPassTest, TwoSidedQuadsAreAllDrawn) {
    set({0, 0}, meshOfParts({{0, kTestedTwoSided, mesh::kAnyDirection, 100},
                             {1, kTestedTwoSided, mesh::kAnyDirection, 50}}));
    for (const float yaw : {0.0f, 45.0f, 90.0f, 180.0f, 270.0f}) {
        const Camera around{.position = glm::dvec3(8, 8, 64) - 60.0 * glm::dvec3(lookDirection({.yaw = yaw})),
                            .yaw = yaw};
        build(around);
        std::set<std::uint32_t> all = stored({0, 0}, 0, kTestedTwoSided, mesh::kAnyDirection);
        all.merge(stored({0, 0}, 1, kTestedTwoSided, mesh::kAnyDirection));
        EXPECT_EQ(drawn(kTestedTwoSided), all) << "yaw " << yaw;
    }
}

TEST_F(CullPassTest, NeighboringDirectionsShareACommand) {
    set({1, 0}, meshOfParts({{1, kOpaque, 0, 3}, {1, kOpaque, 2, 4}, {1, kOpaque, 6, 5}}));
    EXPECT_EQ(build({.position = {8, 8, 100}}).commands[kOpaque].size(), 1u);
    EXPECT_EQ(drawn(kOpaque).size(), 12u);
}

TEST_F(CullPassTest, LongRangesAreSplit) {
    constexpr std::uint32_t kCount = 2 * shared::kMaxQuadsPerCommand + 100;
    set({9, 9}, meshOfParts({{0, kOpaque, mesh::kAnyDirection, 1}}));
    set({1, 0}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, kCount}}));
    const auto& commands = build({.position = {8, 8, 100}}).commands[kOpaque];
    ASSERT_EQ(commands.size(), 3u);
    EXPECT_EQ(commands[0].command.indexCount, 6 * shared::kMaxQuadsPerCommand);
    EXPECT_EQ(commands[2].command.indexCount, 6 * 100u);
    EXPECT_EQ(drawn(kOpaque), stored({1, 0}, 1, kOpaque, mesh::kAnyDirection));
}

// Squared horizontal distances in chunks of the commands of a list, in their order.
std::vector<int> distances(const std::vector<CullPass::Draw>& draws,
                           const std::map<std::uint32_t, world::ChunkPos>& chunkOfQuad,
                           world::ChunkPos from) {
    std::vector<int> result;
    for (const auto& [command, record] : draws) {
        const world::ChunkPos chunk = std::prev(chunkOfQuad.upper_bound(record.firstQuad))->second;
        EXPECT_EQ(glm::ivec2(chunk.x, chunk.y), record.chunk);
        const int x = chunk.x - from.x, y = chunk.y - from.y;
        result.push_back(x * x + y * y);
    }
    return result;
}

TEST_F(CullPassTest, TheNearestAreDrawnFirst) {
    std::map<std::uint32_t, world::ChunkPos> chunkOfQuad;
    for (int y = -4; y <= 4; ++y) {
        for (int x = -4; x <= 4; ++x) {
            set({x, y},
                meshOfParts({{0, kOpaque, mesh::kAnyDirection, 3}, {2, kOpaque, mesh::kAnyDirection, 2}}));
            chunkOfQuad[mesh::firstQuad(quads_->meshSectionsOf({x, y})[0])] = {x, y};
        }
    }
    for (const Camera& camera :
         {Camera{{3, 5, 240}, 30, -30}, Camera{{3, 5, 10}, 200, 30}, Camera{{40, 8, 130}, 0, 0}}) {
        const std::vector<int> order =
            distances(build(camera).commands[kOpaque], chunkOfQuad, cameraChunk(camera));
        EXPECT_GE(order.size(), 9u);
        EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
    }
}

// The order must not depend on that of the hash table, nor on the order in which chunks came.
TEST_F(CullPassTest, OrderDependsOnPlacesOnly) {
    std::vector<std::uint32_t> first;
    for (int round = 0; round < 2; ++round) {
        clear();
        for (int k = 0; k < 81; ++k) {
            const int at = round == 0 ? k : 80 - k;
            const auto count = static_cast<std::uint32_t>(at + 1);  // tells which chunk it is
            set({at % 9 - 4, at / 9 - 4}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, count}}));
        }
        std::vector<std::uint32_t> counts;
        for (const auto& draw : build({.position = {8, 8, 120}}).commands[kOpaque]) {
            counts.push_back(draw.command.indexCount);
        }
        if (round == 0) first = counts;
        EXPECT_EQ(counts, first);
    }
}

TEST_F(CullPassTest, ReplacedAndRemovedChunksAreGone) {
    set({1, 0}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, 5}}));
    set({2, 0}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, 6}}));
    set({1, 0},
        meshOfParts({{1, kOpaque, mesh::kAnyDirection, 7}, {1, kTestedTwoSided, mesh::kAnyDirection, 1}}));
    EXPECT_EQ(build({.position = {8, 8, 100}}).quadCount, 14u);
    meshSections_->remove({1, 0});
    EXPECT_EQ(build({.position = {8, 8, 100}}).quadCount, 6u);
    meshSections_->remove({2, 0});
    EXPECT_EQ(build({.position = {8, 8, 100}}).quadCount, 0u);
}

// A mesh section a chunk over a large area, against the test of a box and a frustum on the CPU.
TEST_F(CullPassTest, ManyMeshSectionsAreCulledAsOneIs) {
    for (int y = -30; y <= 30; ++y) {
        for (int x = -30; x <= 30; ++x) {
            set({x, y}, meshOfParts({{(x + y) & 3, kOpaque, mesh::kAnyDirection, 1}}));
        }
    }
    for (const Camera& camera : {Camera{{3, 5, 240}, 30, -30}, Camera{{3, 5, 10}, 200, 10}}) {
        const Frustum frustum = frustumOf(viewMatrices(camera, 1).viewProjection);
        std::size_t expected = 0;
        for (int y = -30; y <= 30; ++y) {
            for (int x = -30; x <= 30; ++x) {
                const glm::vec3 low(16 * x, 16 * y, 64 * ((x + y) & 3));
                expected += mayBeVisible(frustum, low - shared::kWaving,
                                         low + glm::vec3(16, 16, 64) + shared::kWaving);
            }
        }
        EXPECT_EQ(build(camera).meshSectionCount, expected);
    }
}

// Four times as wide, as high as all.
TEST_F(CullPassTest, BoxesOfHigherLevelsAreWider) {
    for (int y = -8; y <= 8; ++y) {
        for (int x = -8; x <= 8; ++x) set({x, y, 2}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, 1}}));
    }
    const glm::dvec3 far(-1e9, 3e8, 0);
    for (const Camera& camera :
         {Camera{{3, 5, 240}, 30, -30}, Camera{{100, -70, 10}, 200, 10}, Camera{far, 0, 0}}) {
        const Frustum frustum = frustumOf(viewMatrices(camera, 1).viewProjection);
        const world::ChunkPos center = cameraChunk(camera);
        std::size_t expected = 0;
        for (int y = -8; y <= 8; ++y) {
            for (int x = -8; x <= 8; ++x) {
                const glm::vec3 low(16 * (4 * x - center.x), 16 * (4 * y - center.y), 64);
                expected += mayBeVisible(frustum, low - shared::kWaving,
                                         low + glm::vec3(64, 64, 64) + shared::kWaving);
            }
        }
        EXPECT_EQ(build(camera).meshSectionCount, expected);
    }
}

// Some drivers were reported to have a wrong gl_VertexID from 2^23 on.
TEST_F(CullPassTest, VertexIdsStayBelowTwoToThe23) {
    constexpr std::uint32_t kQuadsBefore = (1u << 23) / 4;
    quads_.emplace(QuadStoreSizes{.firstQuads = kQuadsBefore + 1024});
    set({9, 9}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, kQuadsBefore}}));
    set({3, 0}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, 5}, {1, kBlended, mesh::kAnyDirection, 7}}));
    std::size_t commands = 0;
    for (const auto& list : build({.position = {8, 8, 100}}).commands) {
        for (const auto& [command, record] : list) {
            ++commands;
            EXPECT_LE(command.baseVertex + 4 * static_cast<std::int64_t>(command.indexCount / 6), 1 << 23);
        }
    }
    EXPECT_GE(commands, 2u);
}

// QuadStore keeps within the limit. If a list has no room all the same, the rest is left out, and nothing is
// written past its end.
TEST_F(CullPassTest, CommandsWithoutRoomAreLeftOut) {
    constexpr std::uint32_t kRoom = 50;
    auto limited = CullPass::create(contentShaders(), gpu::queryDevice(), {.commands = kRoom});
    ASSERT_TRUE(limited) << limited.error().message;
    pass_.emplace(std::move(*limited));
    for (int k = 0; k < 81; ++k)
        set({k % 9 - 4, k / 9 - 4},
            meshOfParts({{1, kOpaque, mesh::kAnyDirection, 3}, {1, kBlended, mesh::kAnyDirection, 2}}));
    const Drawn& list = build({.position = {-80, 8, 120}});
    EXPECT_EQ(list.commands[kOpaque].size(), kRoom) << "the nearest";
    EXPECT_EQ(drawn(kOpaque).size(), 3 * kRoom);
    EXPECT_TRUE(list.commands[kBlended].empty());
}

TEST_F(CullPassTest, BlendedFacesInViewAreKnown) {
    set({3, 0}, meshOfParts({{1, kBlended, mesh::kAnyDirection, 5}}));
    set({-3, 0}, meshOfParts({{1, kOpaque, mesh::kAnyDirection, 5}}));
    const auto isKnown = [&](float yaw) {
        const Camera camera{.position = {8, 8, 100}, .yaw = yaw};
        return !meshSections_
                    ->blendedRects(cameraChunk(camera), viewMatrices(camera, 1).viewProjection, {64, 64})
                    .empty();
    };
    EXPECT_TRUE(isKnown(0));
    EXPECT_FALSE(isKnown(180));
    const auto isKnownBeyond = [&](float x) {
        const Camera camera{.position = {x, 8, 100}, .yaw = 0};
        const glm::mat4 atOrigin = viewMatrices(camera, 1).viewProjection *
                                   glm::translate(glm::mat4(1), glm::vec3(-16 * cameraChunk(camera).x, 0, 0));
        return !meshSections_->blendedRects({}, atOrigin, {64, 64}).empty();
    };
    EXPECT_TRUE(isKnownBeyond(64.0f + 0.6f * shared::kWaving)) << "waves leave the box";
    EXPECT_FALSE(isKnownBeyond(64.0f + 1.1f * shared::kWaving));
    meshSections_->remove({3, 0});
    EXPECT_FALSE(isKnown(0));
}

}  // namespace
}  // namespace terrane::render
