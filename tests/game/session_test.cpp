#include "terrane/game/session.h"

#include <gmock/gmock.h>

#include "terrane/game/items.h"
#include "terrane/light/light_chunk.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

const world::BlockPos kOnGround{5, 5, kGroundHeight};

EditCommand put(world::BlockPos pos, std::string_view name, PlayerId player = kNoPlayer) {
    return {player, pos, world::SetBlock{contentBlock(name)}, std::nullopt};
}

TEST_F(SessionTest, AnAppliedEditChangesTheWorld) {
    EXPECT_EQ(session_.edit(put(kOnGround, "sand")), EditResult::Applied);
    EXPECT_EQ(session_.world().block(kOnGround), contentBlock("sand"));
    EXPECT_EQ(session_.edit(put(kOnGround, "sand")), EditResult::Unchanged);
    EXPECT_EQ(session_.edit(put({5, 5, 100}, "poppy")), EditResult::Unchanged) << "it has no ground";
}

TEST_F(SessionTest, EditsOutsideOfWhatIsLoadedAreRefused) {
    EXPECT_EQ(session_.edit(put({5000, 5, 70}, "sand")), EditResult::NotLoaded);
    EXPECT_EQ(session_.edit(put({5, 5, 256}, "sand")), EditResult::NotLoaded);
    EXPECT_EQ(session_.edit(put({5, 5, -1}, "sand")), EditResult::NotLoaded);
}

TEST_F(SessionTest, PlayersReachEightBlocks) {
    EXPECT_EQ(session_.edit(put(kOnGround, "sand", 7)), EditResult::OutOfReach) << "nobody knows player 7";
    session_.setPlayer(7, {.position = {5.5, 5.5, kGroundHeight + 8.0}});
    EXPECT_EQ(session_.edit(put(kOnGround, "sand", 7)), EditResult::Applied);
    EXPECT_EQ(session_.edit(put({5, 20, kGroundHeight}, "sand", 7)), EditResult::OutOfReach);
    session_.removePlayer(7);
    EXPECT_EQ(session_.edit(put(kOnGround, "air", 7)), EditResult::OutOfReach);
    EXPECT_EQ(session_.world().block(kOnGround), contentBlock("sand"));
}

TEST_F(SessionTest, AnAuthorityIsToldOfEachOfManyEdits) {
    session_.setPlayer(7, {.position = {5.5, 5.5, kGroundHeight + 2.0}});
    std::vector<world::BlockPos> told;
    Authority authority;
    authority.edited = [&](const EditCommand& command, auto) { told.push_back(command.pos); };
    session_.setAuthority(authority);
    const world::BlockPos beside{6, 5, kGroundHeight};
    const std::vector<EditCommand> commands = {put(kOnGround, "sand", 7), put(beside, "sand", 7),
                                               put({7, 5, kGroundHeight}, "sand")};
    EXPECT_THAT(session_.edit(commands), testing::Each(EditResult::Applied));
    EXPECT_THAT(told, testing::ElementsAre(kOnGround, beside)) << "nobody asks for a script";
}

TEST_F(SessionTest, AChestIsBrokenOnlyWhenItIsEmpty) {
    session_.setPlayer(7, {.position = {5.5, 5.5, kGroundHeight + 2.0}});
    ASSERT_EQ(session_.edit(put(kOnGround, "chest", 7)), EditResult::Applied);
    world::Inventory items(27);
    items[3] = {"stone", 2};
    ASSERT_EQ(putItems(session_, 7, kOnGround, items), EditResult::Applied);
    EXPECT_EQ(session_.edit(put(kOnGround, "air", 7)), EditResult::NotEmpty);
    EXPECT_EQ(itemsOf(session_.world(), session_.blocks(), kOnGround).value(), items);
    ASSERT_EQ(putItems(session_, 7, kOnGround, world::Inventory(27)), EditResult::Applied);
    EXPECT_EQ(session_.edit(put(kOnGround, "air", 7)), EditResult::Applied);
}

// A player who dug through the lowest layer would fall forever.
TEST_F(SessionTest, NoPlayerBreaksTheLowestLayer) {
    session_.setPlayer(7, {.position = {5.5, 5.5, 2}});
    EXPECT_EQ(session_.edit(put({5, 5, 1}, "air", 7)), EditResult::Applied);
    EXPECT_EQ(session_.edit(put({5, 5, 0}, "air", 7)), EditResult::Protected);
    EXPECT_EQ(session_.edit(put({5, 5, 0}, "sand", 7)), EditResult::Protected);
    EXPECT_EQ(session_.world().block({5, 5, 0}), contentBlock("stone"));
    EXPECT_EQ(session_.edit(put({5, 5, 0}, "air")), EditResult::Applied) << "a script may";
    EXPECT_EQ(session_.edit(put({5, 5, 0}, "sand", 7)), EditResult::Applied) << "and a player may fill it";
}

// Two players see the same block and break it: the second one breaks nothing that it did not see.
TEST_F(SessionTest, AnotherBlockThanExpectedIsAConflict) {
    EditCommand command = put(kOnGround, "sand");
    command.expected = contentBlock("stone");
    EXPECT_EQ(session_.edit(command), EditResult::Conflict);
    EXPECT_EQ(session_.world().block(kOnGround), world::kAir);
    command.expected = world::kAir;
    EXPECT_EQ(session_.edit(command), EditResult::Applied);
}

TEST_F(SessionTest, ABatchAnswersEachCommand) {
    const std::vector<EditCommand> commands = {put(kOnGround, "sand"), put(kOnGround, "sand"),
                                               put({5000, 5, 70}, "sand"), put(kOnGround, "stone")};
    const std::vector<EditResult> expected = {EditResult::Applied, EditResult::Unchanged,
                                              EditResult::NotLoaded, EditResult::Applied};
    EXPECT_EQ(session_.edit(commands), expected);
    EXPECT_EQ(session_.world().block(kOnGround), contentBlock("stone"));
}

// Reports edits, uses, builds and undo with their consequences, but no changes by the world itself.
TEST_F(SessionTest, ListenersHearWhatPlayersChanged) {
    std::vector<std::pair<PlayerId, std::vector<ChangedBlock>>> heard;
    const Subscription listening = session_.events.changed.add([&](const BlocksChanged& event) {
        heard.push_back({event.author.player, {event.blocks.begin(), event.blocks.end()}});
    });
    session_.setPlayer(7, {.position = {5.5, 5.5, kGroundHeight + 2.0}});
    session_.edit(put(kOnGround, "sand"));
    EXPECT_TRUE(heard.empty()) << "the world did it";
    session_.edit(put(kOnGround, "glass", 7));
    session_.edit(put({5, 5, kGroundHeight - 1}, "air", 7));
    session_.edit(put({6, 5, kGroundHeight}, "chest", 7));
    world::Inventory items(27);
    items[3] = {"stone", 2};
    putItems(session_, 7, {6, 5, kGroundHeight}, items);
    session_.build({7, FillBox{{{3, 3, 70}, {4, 4, 71}}, contentBlock("glass"), 0, {}}});
    session_.undoOrRedo(7, HistoryWay::Undo);
    ASSERT_EQ(heard.size(), 6u);
    for (const auto& [player, changes] : heard) EXPECT_EQ(player, 7u);
    ASSERT_EQ(heard[0].second.size(), 1u);
    EXPECT_EQ(heard[0].second[0].before.id, contentBlock("sand"));
    EXPECT_EQ(heard[0].second[0].after.id, contentBlock("glass"));
    EXPECT_EQ(heard[3].second.size(), 1u);
    EXPECT_NE(heard[3].second[0].after.data, nullptr) << "of the chest";
    EXPECT_EQ(heard[4].second.size(), 8u);
    EXPECT_EQ(heard[5].second.size(), 8u);
    EXPECT_EQ(heard[5].second[0].after.id, world::kAir);
}

// Blocks as a server sends them: sand hangs in the air until the server lets it fall.
TEST_F(SessionTest, BlocksThatAreSetStayAsTheyAre) {
    const world::BlockValue sand{contentBlock("sand"), 0, {}}, poppy{contentBlock("poppy"), 0, {}};
    session_.setBlocks(std::vector<world::PlacedBlock>{
        {{5, 5, 100}, sand}, {{6, 5, 100}, poppy}, {{5000, 5, 100}, sand}, {{5, 5, 300}, sand}});
    EXPECT_EQ(session_.world().block({5, 5, 100}), sand.id);
    EXPECT_EQ(session_.world().block({6, 5, 100}), poppy.id);
    settle();
    EXPECT_FALSE(takeChanges().empty());
    session_.setBlocks(std::vector<world::PlacedBlock>{{{5, 5, 100}, {}}});
    EXPECT_EQ(session_.world().block({5, 5, 100}), world::kAir);
}

TEST_F(SessionTest, AnEditIsOnScreenWithTheNextUpdate) {
    takeChanges();
    session_.edit(put(kOnGround, "lamp_red"));
    session_.pipeline().update();
    bool isMeshed = false, isLit = false;
    for (const stream::ChunkChange& change : takeChanges()) {
        if (change.pos != world::ChunkPos{0, 0}) continue;
        isMeshed = change.mesh != nullptr;
        isLit = change.light && change.light->get(6, 5, kGroundHeight) != 0;
    }
    EXPECT_TRUE(isMeshed && isLit);
}

TEST_F(SessionTest, SavingReachesTheStore) {
    session_.edit(put(kOnGround, "sand"));
    EXPECT_FALSE(session_.store().contains({0, 0}));
    ASSERT_TRUE(session_.save());
    const store::LoadedChunk stored = session_.store().load({0, 0});
    ASSERT_EQ(stored.state, store::LoadedChunk::State::Present);
    EXPECT_EQ(stored.chunk->block(world::blockIndex(kOnGround)), contentBlock("sand"));
}

TEST_F(SessionTest, TimeLetsPlantsGrow) {
    session_.edit(put(kOnGround, "dirt"));
    const world::BlockPos plant{5, 5, kGroundHeight + 1};
    session_.edit(put(plant, "wheat"));
    const std::uint16_t young = session_.world().blockState(plant);
    ASSERT_GT(young, 0);
    const double before = session_.clock.timeDay;
    for (int second = 0; second < 3600 && session_.world().blockState(plant) > 0; ++second) {
        session_.advance(1, {0, 0});
    }
    EXPECT_EQ(session_.world().blockState(plant), 0) << "grown within an hour";
    EXPECT_NE(session_.clock.timeDay, before);
}

// Falling sand is lit, meshed and saved like any edit.
TEST_F(SessionTest, SandThatFallsReachesTheStoreAndTheScreen) {
    const world::BlockPos high{5, 5, kGroundHeight + 9}, landing = kOnGround;
    session_.edit(put({5, 5, kGroundHeight + 8}, "stone"));
    session_.edit(put(high, "sand"));
    settle();
    takeChanges();
    EXPECT_EQ(session_.edit(put({5, 5, kGroundHeight + 8}, "air")), EditResult::Applied);
    EXPECT_EQ(session_.world().block(high), world::kAir);
    EXPECT_EQ(session_.world().block(landing), contentBlock("sand"));
    settle();
    const light::LightTable table(contentBlocks());
    int lit = 0, meshed = 0;
    for (const stream::ChunkChange& change : takeChanges()) {
        meshed += change.pos == world::ChunkPos{0, 0} && (change.mesh || change.needsMesh);
        if (!change.light) continue;
        ++lit;
        stream::ChunkNeighborhood around;
        for (int n = 0; n < 9; ++n) {
            around.chunks[static_cast<std::size_t>(n)] =
                session_.world().maybeChunkAt(world::offsetBy(change.pos, n % 3 - 1, n / 3 - 1));
        }
        EXPECT_EQ(*change.light, *stream::lightOf(around, table)) << change.pos.x << ' ' << change.pos.y;
    }
    EXPECT_GT(lit, 0);
    EXPECT_GT(meshed, 0);
    ASSERT_TRUE(session_.save());
    const store::LoadedChunk stored = session_.store().load({0, 0});
    EXPECT_EQ(stored.chunk->block(world::blockIndex(landing)), contentBlock("sand"));
    EXPECT_EQ(stored.chunk->block(world::blockIndex(high)), world::kAir);
}

// A fill and a clear by the session, over several chunks: the light equals lighting everything from scratch.
TEST_F(SessionTest, LightAfterABatchIsThatFromScratch) {
    const auto fill = [&](std::string_view name) {
        std::vector<EditCommand> commands;
        for (int z = kGroundHeight - 16; z < kGroundHeight + 16; ++z)
            for (int y = -9; y < 23; ++y)
                for (int x = -9; x < 23; ++x) commands.push_back(put({x, y, z}, name));
        session_.edit(commands);
        settle();
    };
    std::map<world::ChunkPos, light::ChunkLightPtr> shown;
    const light::LightTable table(contentBlocks());
    for (const char* name : {"lamp_green", "stone", "air"}) {
        fill(name);
        for (const stream::ChunkChange& change : takeChanges()) {
            if (change.light) shown[change.pos] = change.light;
        }
        for (const auto& [pos, light] : shown) {
            if (world::chunkDistance(pos, {0, 0}) > 2) continue;
            stream::ChunkNeighborhood around;
            for (int n = 0; n < 9; ++n) {
                around.chunks[static_cast<std::size_t>(n)] =
                    session_.world().maybeChunkAt(world::offsetBy(pos, n % 3 - 1, n / 3 - 1));
            }
            EXPECT_EQ(*light, *stream::lightOf(around, table)) << name << ' ' << pos.x << ' ' << pos.y;
        }
    }
    EXPECT_EQ(shown.size(), 25u);
}

}  // namespace
}  // namespace terrane::game
