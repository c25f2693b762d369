// Buildings of players are visible from beyond the view distance, at once and after a restart.
#include <cmath>
#include <filesystem>
#include <glm/trigonometric.hpp>

#include "terrane/base/files.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "terrane/stream/tile_table.h"
#include "terrane/view/camera_path.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr int kAround = 6, kDetail = 8;
constexpr glm::ivec2 kEditsSize{160, 96};
constexpr world::BlockPos kTown{-1024, 512, 0};
constexpr int kTownBlocks = 64;

// Looks at the middle of the town from this many chunks to the south, with a field of view that shows it at
// about the same size from any distance.
render::Camera cameraAt(int chunks) {
    const glm::dvec3 town{kTown.x + kTownBlocks / 2, kTown.y + kTownBlocks / 2, 175};
    const double away = chunks * 16.0, above = away * 0.12;
    render::Camera camera{{town.x, town.y - away, town.z + above}, 0, 0};
    camera.pitch = static_cast<float>(-glm::degrees(std::atan2(above, away)));
    camera.fieldOfView = static_cast<float>(glm::degrees(2 * std::atan(1.5 * kTownBlocks / away)));
    for (camera.yaw = 0; render::lookDirection(camera).y < 0.9; camera.yaw += 90) {
    }
    return camera;
}

class FarEditsTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        folder_.emplace(base::TemporaryFolder::make(testing::TempDir(), "far_edits_").value());
    }

    std::unique_ptr<DrawnSession> open(std::string_view name) {
        auto saved =
            store::SqliteStore::open(folder_->path() / name, contentBlocks(),
                                     {.create = store::WorldIdentity{1, "overworld", 1}, .decide = {}});
        return makeDrawnSession(
            {.size = kEditsSize, .viewDistance = kAround, .store = std::move(saved).value()});
    }

    static void look(DrawnSession& player, const render::Camera& camera, int horizon) {
        player.view->setHorizon({horizon, kDetail});
        loadAll(*player.session, *player.view, camera, kAround, std::chrono::steady_clock::now());
    }

    static base::Image imageAt(DrawnSession& player, int chunks, float time) {
        const render::Camera camera = cameraAt(chunks);
        look(player, camera, 2 * chunks);
        return player.draw({camera, world::environmentAt(time), 1e6f, 0, render::View::Color});
    }

    // A platform with lamps, a tower of one block and a pit. With `isThere` false all is as it was.
    static void build(DrawnSession& player, bool isThere) {
        look(player, cameraAt(0), 0);
        std::vector<game::EditCommand> commands;
        const auto put = [&](int x, int y, int z, std::string_view name) {
            const world::BlockPos pos{kTown.x + x, kTown.y + y, z};
            const world::Chunk& before = generated(player, world::chunkOf(pos));
            const world::BlockId id = isThere ? contentBlock(name) : before.block(world::blockIndex(pos));
            commands.push_back({game::kNoPlayer, pos, world::SetBlock{id}, std::nullopt});
        };
        for (int y = 0; y < kTownBlocks; ++y) {
            for (int x = 0; x < kTownBlocks; ++x) {
                put(x, y, 180, "snow");
                if (x % 8 < 2 && y % 8 < 2) put(x, y, 181, "lamp_red");
            }
        }
        for (int z = 181; z < 241; ++z) put(10, 10, z, "stone");
        for (int n = 0; n < 16 * 16 * 40; ++n) put(80 + n % 16, n / 16 % 16, 60 + n / 256, "air");
        player.session->edit(commands);
        ASSERT_TRUE(player.session->save());
    }

    static const world::Chunk& generated(DrawnSession& player, world::ChunkPos pos) {
        static std::map<std::pair<int, int>, world::Chunk> chunks;
        const auto [found, isNew] = chunks.try_emplace({pos.x, pos.y});
        if (isNew) found->second = player.session->generator().generate(pos);
        return found->second;
    }

    static int different(const base::Image& a, const base::Image& b) {
        int count = 0;
        for (std::size_t k = 0; k < a.rgba.size(); k += 4) {
            int sum = 0;
            for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a.rgba[k + c] - b.rgba[k + c]);
            count += sum > 30;
        }
        return count;
    }

    std::optional<base::TemporaryFolder> folder_;
};

TEST_F(FarEditsTest, ATownIsSeenFromFarAway) {
    const auto empty = open("empty.terrane");
    auto player = open("town.terrane");
    build(*player, true);
    std::vector<base::Image> images;
    for (const int chunks : {30, 300}) {
        for (const float time : {0.5f, 0.0f}) {
            images.push_back(imageAt(*player, chunks, time));
            EXPECT_GT(different(images.back(), imageAt(*empty, chunks, time)), 100)
                << chunks << " chunks away at " << time;
        }
    }
    player.reset();
    player = open("town.terrane");
    for (const int chunks : {30, 300}) {
        for (const float time : {0.5f, 0.0f}) {
            EXPECT_EQ(different(imageAt(*player, chunks, time),
                                images[(chunks == 300 ? 2u : 0u) + (time < 0.1f ? 1u : 0u)]),
                      0);
        }
    }
}

// A save that is only read keeps its tiles in memory, and builds them when they are first needed.
TEST_F(FarEditsTest, AWorldWithoutTilesGetsThemWithTheHorizon) {
    auto store = std::make_unique<store::MemoryStore>(store::WorldIdentity{1, "overworld", 1});
    auto chunk = std::make_shared<world::Chunk>();
    chunk->setBlock(world::blockIndex(1, 1, 200), contentBlock("lamp_red"));
    store->save({0, 0}, chunk, store::Provenance::Edited);
    ASSERT_TRUE(store->flush());
    const auto player =
        makeDrawnSession({.size = kEditsSize, .viewDistance = kAround, .store = std::move(store)});
    const world::ChunkPos tile = stream::parentOf({0, 0});
    player->view->setHorizon({0, kDetail});
    EXPECT_FALSE(player->session->store().contains(tile));
    player->view->setHorizon({64, kDetail});
    EXPECT_TRUE(player->session->store().contains(tile));
}

TEST_F(FarEditsTest, WhatIsRemovedLeavesNothing) {
    const auto player = open("town.terrane");
    const base::Image before = imageAt(*player, 30, 0.5f);
    build(*player, true);
    EXPECT_GT(different(imageAt(*player, 30, 0.5f), before), 100);
    build(*player, false);
    EXPECT_EQ(different(imageAt(*player, 30, 0.5f), before), 0);
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 4; ++y) {
            world::ChunkPos pos = world::offsetBy(world::chunkOf(kTown), x, y);
            while (pos.level < 9) {
                pos = stream::parentOf(pos);
                EXPECT_FALSE(player->session->store().contains(pos)) << store::nameOf(pos);
            }
        }
    }
}

}  // namespace
}  // namespace terrane::view
