// Commands that change blocks where they are not allowed, or too many: each is answered, and none harms the
// world.
#include "tests/net/hostile_fixture.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "terrane/store/chunks/structure_file.h"
#include "terrane/world/blocks/inventory.h"
#include "terrane/world/blocks/sign.h"

namespace terrane::net {
namespace {

using game::EditResult;
using BuildResult = game::BuildOutcome::Result;
using TakenResult = game::UndoResult::Outcome;

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min(),
                       kHighest = std::numeric_limits<std::int32_t>::max();

class HostileBuilding : public HostileTest {
  protected:
    Fill fill(CommandNumber number, world::BlockPos low, world::BlockPos high) const {
        return {number, {{low, high}, contentBlock("glass"), 0, {}}};
    }
    static Bytes chestData(const std::string& item) {
        const int slots = contentBlocks().find("chest")->slots;
        world::Inventory inventory(static_cast<std::size_t>(slots));
        for (world::ItemStack& stack : inventory) stack = {item, 1};
        return world::encodeInventory(inventory);
    }
    // A row of blocks along x, each with data.
    static Bytes structureWith(const std::vector<std::string>& names, const std::vector<Bytes>& data) {
        world::Structure structure;
        structure.size = {static_cast<int>(names.size()), 1, 1};
        for (std::uint32_t k = 0; k < names.size(); ++k) {
            structure.palette.push_back({names[k], 0});
            structure.cells.push_back(k);
            structure.data.push_back({k, std::make_shared<const world::BlockEntityData>(data[k])});
        }
        return store::encodeStructure(structure).value();
    }
};

TEST_F(HostileBuilding, StructuresAreFewAndMayBeNone) {
    start();
    loadAround(nearSpawn());
    const auto bob = joined("Bob");
    expectDecision(*bob, Place{1, nearSpawn(), Bytes(1000, std::byte{7})}, 1, BuildResult::Empty);
    world::Structure structure;
    structure.size = {2, 2, 2};
    structure.palette = {{"glass", 0}};
    structure.cells.assign(8, 0);
    const Bytes bytes = store::encodeStructure(structure).value();
    for (const std::int32_t x : {kLowest, kHighest})
        expectDecision(*bob, Place{2, {x, x, 255}, bytes}, 2, BuildResult::OutOfReach);
    world::BlockPos top = nearSpawn();
    top.z = 255;
    bob->say(Move{wirePose({{top.x + 0.5, top.y + 0.5, 250}, 0, 0})});
    expectDecision(*bob, Place{3, top, bytes}, 3, BuildResult::OutOfWorld);
    for (CommandNumber k = 10; k < 110; ++k) bob->say(Place{k, nearSpawn(), bytes});
    EXPECT_TRUE(decision(*bob, 109)) << "all are answered";
    EXPECT_TRUE(plays(*bob));
}

TEST_F(HostileBuilding, UndoOfMuchIsRationed) {
    start();
    const world::BlockPos low = nearSpawn();
    loadAround(low);
    const auto bob = joined("Bob");
    expectDecision(*bob, fill(1, low, {low.x + 15, low.y + 15, low.z + 15}), 1, BuildResult::Done);
    for (CommandNumber k = 2; k < 102; ++k) bob->say(TakeBack{k, k % 2 == 1});
    const std::int64_t before = server_->state().history.newest;
    loadAround(low);
    for (int k = 0; k < 20; ++k) server_->tick();
    // 131,072 blocks at once plus 20,000 in this second allow 36 fills of 4096 blocks, in four chunks each.
    EXPECT_LE(server_->state().history.newest - before, 40 * 4);
    EXPECT_GE(server_->state().history.newest - before, 32 * 4);
    EXPECT_TRUE(plays(*bob));
}

TEST_F(HostileBuilding, FillsOfMuchAreRationed) {
    start();
    const world::BlockPos low = nearSpawn();
    loadAround(low);
    const auto bob = joined("Bob");
    const auto fills = [&](CommandNumber first) {
        for (CommandNumber k = first; k < first + 60; ++k)
            bob->say(fill(k, low, {low.x + 15, low.y + 15, low.z + 15}));
        std::vector<BuildResult> results;
        for (int tick = 0; tick < 100 && results.size() < 60; ++tick) {
            server_->tick();
            for (const ServerMessage& message : bob->take())
                if (const auto* done = std::get_if<Done>(&message))
                    results.push_back(static_cast<BuildResult>(done->result));
        }
        return results;
    };
    // 131,072 blocks at once, of which a fill takes 4,096.
    const std::vector<BuildResult> at = fills(1);
    ASSERT_EQ(at.size(), 60u);
    EXPECT_EQ(at.front(), BuildResult::Done);
    EXPECT_GT(std::ranges::count(at, BuildResult::TooSoon), 10);
    server_->now += std::chrono::seconds(10);
    loadAround(low);
    EXPECT_EQ(fills(61).front(), BuildResult::Done);
}

TEST_F(HostileBuilding, EditsOutOfReach) {
    start();
    const auto bob = joined("Bob");
    const world::BlockPos near = nearSpawn();
    CommandNumber number = 0;
    for (const std::int32_t x :
         {kLowest, kLowest + 15, near.x - 100000, near.x + 20, kHighest - 15, kHighest})
        for (const std::int32_t z : {0, 255}) {
            ++number;
            expectDecision(*bob, put(number, {x, near.y, z}), number, EditResult::OutOfReach);
        }
    EXPECT_TRUE(server_->state().session.world().chunkCount() < 30)
        << "chunks far away are not loaded for it";
}

TEST_F(HostileBuilding, BlocksOfNoTypeAreRefused) {
    start();
    const world::BlockPos pos = nearSpawn();
    loadAround(pos);
    const auto bob = joined("Bob");
    const auto none = static_cast<world::BlockId>(contentBlocks().types().size());
    for (const world::BlockId id : {none, world::BlockId{65535}}) {
        expectDecision(*bob, Edit{1, pos, world::SetBlock{id}, {}}, 1, EditResult::BadData);
        Fill of = fill(2, pos, pos);
        of.fill.id = id;
        expectDecision(*bob, of, 2, BuildResult::Empty);
    }
    EXPECT_EQ(server_->state().session.world().block(pos), world::kAir);
    EXPECT_EQ(server_->state().history.newest, 0);
}

TEST_F(HostileBuilding, DataIsForBlocksThatKeepSome) {
    start();
    const world::BlockPos pos = nearSpawn();
    loadAround(pos);
    const auto bob = joined("Bob");
    const world::SetEntityData data{chestData("stone")}, noise{Bytes(100)};
    expectDecision(*bob, put(1, pos), 1, EditResult::Applied);
    expectDecision(*bob, Edit{2, pos, data, {}}, 2, EditResult::BadData);
    expectDecision(*bob, put(3, pos, "chest"), 3, EditResult::Applied);
    expectDecision(*bob, Edit{4, pos, noise, {}}, 4, EditResult::BadData);
    expectDecision(*bob, Edit{5, pos, data, {}}, 5, EditResult::Applied);
    const auto refused = [&](CommandNumber number, const Bytes& bytes) {
        expectDecision(*bob, Edit{number, pos, world::SetEntityData{bytes}, {}}, number, EditResult::BadData);
    };
    world::Inventory hidden(301), large(27);
    hidden[300] = {"stone", 1};
    large[0] = {"stone", 65535};
    refused(6, world::encodeInventory(hidden));
    refused(7, world::encodeInventory(world::Inventory(10000)));
    refused(8, world::encodeInventory(large));
    refused(9, chestData("\x1b[31m\n<script>"));
    refused(10, chestData("no_such_block"));
    refused(11, chestData(std::string(255, 'x')));
}

TEST_F(HostileBuilding, DataOfStructuresIsForBlocksThatKeepSome) {
    start();
    const world::BlockPos pos = nearSpawn();
    loadAround(pos);
    const auto bob = joined("Bob");
    expectDecision(
        *bob,
        Place{1, pos,
              structureWith({"stone", "chest", "chest"}, {Bytes(100), Bytes(100), chestData("stone")})},
        1, BuildResult::Done);
    const world::World& world = server_->state().session.world();
    EXPECT_EQ(world::blockValue(world, pos).data, nullptr);
    EXPECT_EQ(world::blockValue(world, {pos.x + 1, pos.y, pos.z}).data, nullptr);
    EXPECT_NE(world::blockValue(world, {pos.x + 2, pos.y, pos.z}).data, nullptr);
    // A stone with 1 MiB of data, which compresses well.
    expectDecision(*bob, Place{2, pos, structureWith({"stone"}, {Bytes(1 << 20)})}, 2, BuildResult::Empty);
}

TEST_F(HostileBuilding, DataOfAChunkIsBounded) {
    start();
    const world::BlockPos pos = nearSpawn();
    loadAround(pos);
    const auto bob = joined("Bob");
    // Signs on stone: 128 of the longest texts, 50 KB.
    std::string line;
    for (std::size_t k = 0; k < world::kSignColumns; ++k) line += "\U0001f438";
    const auto text =
        std::make_shared<const world::BlockEntityData>(world::encodeSign({line, line, line, line}));
    world::Structure signs;
    signs.size = {8, 8, 4};
    signs.palette = {{"stone", 0}, {"sign", 0}};
    for (std::uint32_t cell = 0; cell < 256; ++cell) {
        signs.cells.push_back(cell / 64 % 2);
        if (cell / 64 % 2 == 1) signs.data.push_back({cell, text});
    }
    const Bytes structure = store::encodeStructure(signs).value();
    int placed = 0;
    const world::ChunkPos chunk = world::chunkOf(pos);
    for (int k = 0; k < 32; ++k) {
        const auto number = static_cast<CommandNumber>(k + 1);
        const world::BlockPos low{chunk.x * 16 + k % 2 * 8, chunk.y * 16 + k / 2 % 2 * 8, pos.z + k / 4 * 4};
        const auto done = decision(*bob, (bob->say(Place{number, low, structure}), number));
        ASSERT_TRUE(done);
        placed += static_cast<BuildResult>(done->result) == BuildResult::Done;
        server_->now += std::chrono::seconds(1);
        loadAround(pos);
    }
    const std::size_t bytes = server_->state().session.world().maybeChunkAt(chunk)->blockEntityDataBytes();
    EXPECT_GT(placed, 10);
    EXPECT_LE(bytes, std::size_t{1} << 20);
    EXPECT_GT(bytes, std::size_t{1} << 19) << "the test shows nothing";
}

TEST_F(HostileBuilding, FillsThatAreNoBoxes) {
    start();
    const world::BlockPos p = nearSpawn();
    loadAround(p);
    const auto bob = joined("Bob");
    const auto expectFill = [&](CommandNumber number, world::BlockPos low, world::BlockPos high,
                                BuildResult result) {
        expectDecision(*bob, fill(number, low, high), number, result);
    };
    expectFill(1, p, {p.x + 100, p.y + 100, p.z + 100}, BuildResult::TooLarge);
    expectFill(2, {kLowest, kLowest, 0}, {kHighest, kHighest, 255}, BuildResult::TooLarge);
    expectFill(3, p, {p.x - 1, p.y, p.z}, BuildResult::Empty);
    // An empty box with corners so far apart that their number of chunks, 65,536², exceeds 32 bits.
    const std::int32_t away = 16 * (65536 - 3) / 2;
    expectFill(4, {p.x - away, p.y - away, p.z}, {p.x + away, p.y + away, p.z - 1}, BuildResult::Empty);
    expectFill(5, {kLowest, kHighest, p.z}, {kHighest, kLowest, p.z}, BuildResult::OutOfReach);
    expectFill(6, {kHighest, kHighest, 255}, {kLowest, kLowest, 0}, BuildResult::OutOfReach);
    expectFill(7, {kHighest, kHighest, 0}, {kHighest, kHighest, 0}, BuildResult::OutOfReach);
    EXPECT_LT(server_->state().session.world().chunkCount(), 100u);
}

TEST_F(HostileBuilding, TheEndsOfTheWorld) {
    start();
    const auto bob = joined("Bob");
    (void)runConsoleLine(server_->state(), "op Bob");
    CommandNumber number = 0;
    for (const std::int32_t x : {kLowest, kHighest})
        for (const std::int32_t y : {kLowest, kHighest}) {
            bob->say(Move{wirePose({{x + 0.5, y + 0.5, 200}, 0, 0})});
            EXPECT_EQ(findMessage<Corrected>(bob->take()), nullptr);
            bob->say(View{world::chunkOf(world::BlockPos{x, y, 0}), 255, 65535});
            loadAround({x, y, 0});
            for (const std::int32_t z : {198, 200}) {
                ++number;
                expectDecision(*bob, put(number, {x, y, z}, z == 200 ? "sand" : "water"), number,
                               EditResult::Applied);
            }
            for (int k = 0; k < 100; ++k) {  // time to fall and flow
                ann_->say(Pong{0});
                bob->say(Pong{0});
                server_->tick();
            }
        }
    EXPECT_TRUE(plays(*bob));
}

TEST_F(HostileBuilding, GuestsAndClaims) {
    start();
    const world::BlockPos pos = nearSpawn();
    loadAround(pos);
    const auto guest = joined("Guest"), bob = joined("Bob");
    expectDecision(*guest, put(1, pos), 1, EditResult::Applied);
    (void)runConsoleLine(server_->state(), "guest Guest");
    expectDecision(*guest, put(2, pos, "air"), 2, EditResult::NotAllowed);
    expectDecision(*guest, fill(3, pos, {pos.x + 1, pos.y, pos.z}), 3, BuildResult::NotAllowed);
    expectDecision(*guest, TakeBack{4, false}, 4, TakenResult::NotAllowed);
    expectDecision(*guest, Edit{5, pos, world::UseBlock{}, {}}, 5, EditResult::NotAllowed);
    (void)runConsoleLine(server_->state(),
                         fmt::format("claim hall {} {} {} {} Ann", pos.x, pos.y, pos.x, pos.y));
    expectDecision(*bob, put(1, pos, "air"), 1, EditResult::Claimed);
    Fill over = fill(2, {pos.x - 2, pos.y, pos.z}, pos);
    over.fill.id = contentBlock("stone");
    expectDecision(*bob, over, 2, BuildResult::NotAllowed);
    EXPECT_EQ(server_->state().session.world().block(pos), contentBlock("glass"));
}

TEST_F(HostileBuilding, AnEditAfterAStallIsToldAsItIs) {
    start(patientSettings());
    const world::BlockPos pos = nearSpawn();
    loadAround(pos);
    const auto bob = joined("Bob");
    ann_->say(View{world::chunkOf(pos), 2, 0});
    bob->say(put(1, pos));
    (void)ann_->take();
    server_->now += std::chrono::seconds(10);  // unloads unused chunks
    std::optional<BlocksChanged> changed;
    for (int k = 0; k < kMostTicks && !changed; ++k) {  // the chunk is loaded again
        server_->tick();
        const auto messages = ann_->take();
        if (const auto* found = findMessage<BlocksChanged>(messages)) changed = *found;
    }
    ASSERT_TRUE(changed);
    EXPECT_EQ(changed->blocks.at(0).value.id, contentBlock("glass"));
}

}  // namespace
}  // namespace terrane::net
