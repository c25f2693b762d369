// A world that 0.1.0 saved (tests/saves/overworld_0.1.sqlite: its window, played by hand): blocks of the
// palette placed around a player, items put into a chest.
#include <gtest/gtest.h>

#include "terrane/game/items.h"
#include "terrane/game/player_state.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/saves/open_world.h"
#include "tests/base/temp_folder.h"
#include "tests/world/content_blocks.h"

namespace terrane::game {
namespace {

constexpr world::BlockPos kChest{9, -97, 83};

class FormerSave : public testing::Test {
  protected:
    FormerSave() {
        std::filesystem::copy_file(TERRANE_SOURCE_DIR "/tests/saves/overworld_0.1.sqlite", file_);
        store::WorldRequest request;
        request.versionOf = [](std::string_view name) {
            return gen::versionOf(gen::builtInGenerators(), name);
        };
        auto opened = store::openWorld(store::worldLocation(file_.string()), blocks_, request);
        EXPECT_TRUE(opened) << opened.error().message;
        store_ = std::move(opened.value());
    }

    base::TempFolder folder_;
    std::filesystem::path file_ = folder_.path() / "w.sqlite";
    const world::BlockRegistry& blocks_ = contentBlocks();
    std::unique_ptr<store::ChunkStore> store_;
};

TEST_F(FormerSave, KeepsItsIdentityAndPlayer) {
    EXPECT_EQ(store_->identity(),
              (store::WorldIdentity{.seed = 7, .generator = "overworld", .generatorVersion = 2}));
    const SavedPlayer player = loadPlayer(*store_);
    ASSERT_TRUE(player.pose && player.timeDay);
    EXPECT_NEAR(player.pose->position.x, 14.275, 0.001);
    EXPECT_NEAR(player.pose->position.y, -96.625, 0.001);
    EXPECT_NEAR(player.pose->position.z, 84.620, 0.001);
    EXPECT_NEAR(player.pose->yaw, 175.5, 0.01);
    EXPECT_NEAR(*player.timeDay, 0.45077, 0.00001);
}

TEST_F(FormerSave, KeepsItsEdits) {
    EXPECT_EQ(store_->editedChunks().value(), (std::vector<world::ChunkPos>{{0, -7}, {0, -6}}));
    world::World world;
    const store::LoadedChunk loaded = store_->load(world::chunkOf(kChest));
    ASSERT_TRUE(loaded.chunk);
    world.insert(world::chunkOf(kChest), loaded.chunk);
    ASSERT_TRUE(isContainer(world, blocks_, kChest));
    const world::Inventory items = itemsOf(world, blocks_, kChest).value();
    world::Inventory expected(27);
    expected[0] = {"stone", 3};
    expected[10] = {"grass", 1};
    expected[26] = {"stone", 99};
    EXPECT_EQ(items, expected);
}

}  // namespace
}  // namespace terrane::game
