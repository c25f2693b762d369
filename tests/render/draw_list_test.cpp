#include "terrane/render/draw_list.h"

#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "tests/gpu/gl_fixture.h"

namespace terrane::render {
namespace {

constexpr int kOpaque = mesh::faceContext(mesh::AlphaClass::Opaque, false);
constexpr int kTestedTwoSided = mesh::faceContext(mesh::AlphaClass::Tested, true);
constexpr int kBlended = mesh::faceContext(mesh::AlphaClass::Blended, true);
constexpr int kRegionHeight = 64;

// How many quads of each context, group and region a mesh made here has.
struct Part {
    int region, context, group;
    std::uint32_t count;
};

// Parts by region, context, group, as the mesher orders them. Regions are full height.
mesh::ChunkMesh meshOfParts(const std::vector<Part>& parts) {
    mesh::ChunkMesh mesh;
    mesh.regions.resize(256 / kRegionHeight);
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
        for (int context = 0; context < mesh::kContextCount; ++context) {
            for (int group = 0; group < mesh::kGroupCount; ++group) {
                mesh::QuadRange range{static_cast<std::uint32_t>(mesh.quads.size()), 0};
                for (const Part& part : parts) {
                    if (part.region != static_cast<int>(r) || part.context != context || part.group != group)
                        continue;
                    range.count = part.count;
                    mesh.quads.resize(mesh.quads.size() + part.count);
                    mesh.regions[r].minZ = static_cast<int>(r) * kRegionHeight;
                    mesh.regions[r].maxZ = mesh.regions[r].minZ + kRegionHeight;
                }
                mesh.regions[r].groups[context][group] = range;
            }
        }
    }
    return mesh;
}

class DrawListTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!IsSkipped()) quads_.emplace();
    }
    void TearDown() override {
        quads_.reset();
        GlTest::TearDown();
    }

    DrawList& build(const Camera& camera) {
        buildDrawList(list_, *quads_, camera, viewMatrices(camera, 1.0f));
        return list_;
    }

    // Numbers of the quads drawn in a context, by place in the buffer; none may be drawn twice.
    std::set<std::uint32_t> drawn(int context) const {
        std::set<std::uint32_t> numbers;
        for (const DrawCommand& command : list_.commands[static_cast<std::size_t>(context)]) {
            EXPECT_EQ(command.instanceCount, 1u);
            EXPECT_EQ(command.firstIndex, 0u);
            EXPECT_EQ(command.indexCount % 6, 0u);
            EXPECT_LE(command.indexCount, 6 * kMaxQuadsPerCommand);
            EXPECT_LT(command.baseInstance, list_.records.size());
            for (std::uint32_t k = 0; k < command.indexCount / 6; ++k) {
                EXPECT_TRUE(numbers.insert(static_cast<std::uint32_t>(command.baseVertex) / 4 + k).second);
            }
        }
        return numbers;
    }

    std::set<std::uint32_t> stored(world::ChunkPos pos, int region, int context, int group) const {
        const ChunkQuads& chunk = quads_->chunks().at(pos);
        const mesh::QuadRange range = chunk.regions[static_cast<std::size_t>(region)].groups[context][group];
        std::set<std::uint32_t> numbers;
        for (std::uint32_t k = 0; k < range.count; ++k) numbers.insert(chunk.first + range.first + k);
        return numbers;
    }

    std::optional<QuadStore> quads_;
    DrawList list_;
};

TEST_F(DrawListTest, NothingGivesNoCommands) {
    const DrawList& list = build({});
    for (const auto& commands : list.commands) EXPECT_TRUE(commands.empty());
    EXPECT_EQ(list.records.size() + list.quadCount + list.regionCount, 0u);
}

TEST_F(DrawListTest, RegionsBehindTheCameraAreCulled) {
    const mesh::ChunkMesh mesh = meshOfParts({{1, kOpaque, mesh::kGroupAlways, 5}});
    quads_->set({3, 0}, mesh);
    quads_->set({-3, 0}, mesh);
    const DrawList& list = build({.position = {8, 8, 100}, .yaw = 0});
    EXPECT_EQ(list.regionCount, 1u);
    EXPECT_EQ(list.quadCount, 5u);
    EXPECT_EQ(drawn(kOpaque), stored({3, 0}, 1, kOpaque, mesh::kGroupAlways));
    EXPECT_EQ(glm::vec3(list.records.at(0).origin), glm::vec3(48, 0, 0));
    build({.position = {8, 8, 100}, .yaw = 180});
    EXPECT_EQ(drawn(kOpaque), stored({-3, 0}, 1, kOpaque, mesh::kGroupAlways));
}

TEST_F(DrawListTest, RegionsAboveAndBelowTheViewAreCulled) {
    quads_->set({3, 0}, meshOfParts({{0, kOpaque, 6, 1}, {1, kOpaque, 6, 2}, {3, kOpaque, 6, 4}}));
    build({.position = {8, 8, 96}, .fieldOfView = 30});
    EXPECT_EQ(drawn(kOpaque), stored({3, 0}, 1, kOpaque, 6));
}

TEST_F(DrawListTest, RecordsAreRelativeToTheCamerasChunk) {
    const world::ChunkPos far{world::kMaxChunk, world::kMinChunk};
    quads_->set(far, meshOfParts({{1, kOpaque, mesh::kGroupAlways, 1}}));
    const glm::dvec3 corner(16.0 * far.x, 16.0 * far.y, 0);
    const auto origin = [&](double x) {
        return build({.position = corner + glm::dvec3(x, 8, 100)}).records.at(0).origin;
    };
    EXPECT_EQ(glm::vec3(origin(-20)), glm::vec3(32, 0, 0));
    EXPECT_EQ(glm::vec3(origin(-40)), glm::vec3(48, 0, 0));
    EXPECT_EQ(origin(-20).w, origin(-40).w) << "the chunk's own number";
}

// Camera and chunk may lie at opposite ends of the world for a frame, after a jump.
TEST_F(DrawListTest, DistancesAcrossTheWorldDoNotOverflow) {
    quads_->set({world::kMaxChunk, 0}, meshOfParts({{1, kOpaque, mesh::kGroupAlways, 1}}));
    const DrawList& list = build({.position = {-2147483640.0, 8, 100}});
    for (const shared::DrawRecord& record : list.records) EXPECT_GT(record.origin.x, 4e9f);
}

TEST_F(DrawListTest, GroupsThatLookAwayAreNotDrawn) {
    std::vector<Part> parts;
    for (int group = 0; group < mesh::kGroupCount; ++group) parts.push_back({1, kOpaque, group, 10});
    quads_->set({0, 0}, meshOfParts(parts));
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
        for (int group = 0; group < mesh::kGroupCount; ++group) {
            if (!c.hidden.contains(group)) expected.merge(stored({0, 0}, 1, kOpaque, group));
        }
        EXPECT_EQ(drawn(kOpaque), expected);
        EXPECT_EQ(list_.quadCount, expected.size());
    }
}

TEST_F(DrawListTest, TwoSidedQuadsAreAllDrawn) {
    quads_->set({0, 0}, meshOfParts({{0, kTestedTwoSided, mesh::kGroupAlways, 100},
                                     {1, kTestedTwoSided, mesh::kGroupAlways, 50}}));
    for (const float yaw : {0.0f, 45.0f, 90.0f, 180.0f, 270.0f}) {
        const Camera around{.position = glm::dvec3(8, 8, 64) - 60.0 * glm::dvec3(lookDirection({.yaw = yaw})),
                            .yaw = yaw};
        build(around);
        std::set<std::uint32_t> all = stored({0, 0}, 0, kTestedTwoSided, mesh::kGroupAlways);
        all.merge(stored({0, 0}, 1, kTestedTwoSided, mesh::kGroupAlways));
        EXPECT_EQ(drawn(kTestedTwoSided), all) << "yaw " << yaw;
    }
}

TEST_F(DrawListTest, NeighbouringGroupsShareACommand) {
    quads_->set({1, 0}, meshOfParts({{1, kOpaque, 0, 3}, {1, kOpaque, 2, 4}, {1, kOpaque, 6, 5}}));
    EXPECT_EQ(build({.position = {8, 8, 100}}).commands[kOpaque].size(), 1u);
    EXPECT_EQ(drawn(kOpaque).size(), 12u);
}

TEST_F(DrawListTest, LongRangesAreSplit) {
    constexpr std::uint32_t kCount = 2 * kMaxQuadsPerCommand + 100;
    quads_->set({9, 9}, meshOfParts({{0, kOpaque, mesh::kGroupAlways, 1}}));
    quads_->set({1, 0}, meshOfParts({{1, kOpaque, mesh::kGroupAlways, kCount}}));
    const auto& commands = build({.position = {8, 8, 100}}).commands[kOpaque];
    ASSERT_EQ(commands.size(), 3u);
    EXPECT_EQ(commands[0].indexCount, 6 * kMaxQuadsPerCommand);
    EXPECT_EQ(commands[2].indexCount, 6 * 100u);
    EXPECT_EQ(drawn(kOpaque), stored({1, 0}, 1, kOpaque, mesh::kGroupAlways));
}

// Distances of the regions in the order of a context's commands, from the middles of their cells.
std::vector<float> distances(const DrawList& list, int context, const Camera& camera,
                             const std::map<std::uint32_t, int>& regionOfCount) {
    const glm::vec3 eye = viewMatrices(camera, 1).cameraPosition;
    std::vector<float> result;
    for (const DrawCommand& command : list.commands[static_cast<std::size_t>(context)]) {
        const int region = regionOfCount.at(command.indexCount / 6);
        const glm::vec3 middle = glm::vec3(list.records[command.baseInstance].origin) +
                                 glm::vec3(8, 8, (static_cast<float>(region) + 0.5f) * kRegionHeight);
        result.push_back(glm::distance(middle, eye));
    }
    return result;
}

TEST_F(DrawListTest, OpaqueIsDrawnNearToFarAndBlendedFarToNear) {
    std::vector<Part> parts;
    std::map<std::uint32_t, int> regionOfCount;
    for (int region = 0; region < 4; ++region) {
        const auto count = static_cast<std::uint32_t>(region + 1);
        parts.push_back({region, kOpaque, mesh::kGroupAlways, count});
        parts.push_back({region, kBlended, mesh::kGroupAlways, count});
        regionOfCount[count] = region;
    }
    for (int y = -4; y <= 4; ++y) {
        for (int x = -4; x <= 4; ++x) quads_->set({x, y}, meshOfParts(parts));
    }
    for (const Camera& camera :
         {Camera{{3, 5, 240}, 30, -30}, Camera{{3, 5, 10}, 200, 30}, Camera{{8, 8, 130}, 0, 0}}) {
        const DrawList& list = build(camera);
        const std::vector<float> opaque = distances(list, kOpaque, camera, regionOfCount);
        std::vector<float> blended = distances(list, kBlended, camera, regionOfCount);
        EXPECT_GT(opaque.size(), 20u);
        EXPECT_TRUE(std::is_sorted(opaque.begin(), opaque.end()));
        EXPECT_TRUE(std::is_sorted(blended.rbegin(), blended.rend())) << "from height " << camera.position.z;
    }
}

// The order must not depend on the hash table's.
TEST_F(DrawListTest, OrderDependsOnPlacesOnly) {
    const mesh::ChunkMesh mesh = meshOfParts({{1, kOpaque, mesh::kGroupAlways, 1}});
    std::vector<glm::vec4> first;
    for (int round = 0; round < 2; ++round) {
        quads_.emplace();
        for (int k = 0; k < 81; ++k) {
            const int at = round == 0 ? k : 80 - k;
            quads_->set({at % 9 - 4, at / 9 - 4}, mesh);
        }
        std::vector<glm::vec4> origins;
        for (const shared::DrawRecord& record : build({.position = {8, 8, 120}}).records) {
            origins.push_back(record.origin);
        }
        if (round == 0) first = origins;
        EXPECT_EQ(origins, first);
    }
}

}  // namespace
}  // namespace terrane::render
