#include "terrane/game/build_command.h"

#include <map>
#include <random>
#include <stdexcept>

#include "terrane/light/light_chunk.h"
#include "terrane/store/chunks/structure_file.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/inventory.h"
#include "terrane/world/blocks/sign.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

using Result = BuildOutcome::Result;
using world::BlockBox;
using world::BlockPos;
using world::BlockValue;

constexpr PlayerId kBuilder = 7;

class BuildTest : public SessionTest {
  protected:
    BuildTest() { session_.setPlayer(kBuilder, {.position = {5.5, 5.5, kGroundHeight + 2.0}}); }

    BuildOutcome fill(const BlockBox& box, std::string_view name,
                      std::optional<world::BlockId> replaced = std::nullopt) {
        return session_.build({kBuilder, FillBox{box, contentBlock(name), 0, replaced}});
    }
    BuildOutcome place(const world::Structure& structure, BlockPos low) {
        return session_.build(
            {kBuilder, PlaceStructure{std::make_shared<const world::Structure>(structure), low}});
    }
    void put(BlockPos pos, std::string_view name, std::uint16_t state = 0) {
        session_.edit({kNoPlayer, pos, world::SetBlock{contentBlock(name), state}, std::nullopt});
    }
    world::Structure copy(const BlockBox& box) {
        return world::copyBlocks(session_.world(), session_.blocks(), box);
    }
    world::BlockId block(BlockPos pos) { return session_.world().block(pos); }
    std::size_t steps() { return session_.undoOrRedo(kBuilder, HistoryWay::Undo).blocks; }

    // The shown light equals lighting everything from scratch.
    void expectLightFromScratch(std::map<world::ChunkPos, light::ChunkLightPtr>& shown) {
        const light::LightTable table(contentBlocks());
        for (const stream::ChunkChange& change : takeChanges())
            if (change.light) shown[change.pos] = change.light;
        for (const auto& [pos, light] : shown) {
            if (world::chunkDistance(pos, {0, 0}) > 2) continue;
            stream::ChunkNeighborhood around;
            for (int n = 0; n < 9; ++n)
                around.chunks[static_cast<std::size_t>(n)] =
                    session_.world().maybeChunkAt(world::offsetBy(pos, n % 3 - 1, n / 3 - 1));
            EXPECT_EQ(*light, *stream::lightOf(around, table)) << pos.x << ' ' << pos.y;
        }
    }
};

const BlockBox kCube{{2, 2, kGroundHeight}, {6, 6, kGroundHeight + 4}};

TEST_F(BuildTest, AFillIsOneStep) {
    const BuildOutcome outcome = fill(kCube, "bricks");
    EXPECT_EQ(outcome.result, Result::Done);
    EXPECT_EQ(outcome.changed, 125u);
    EXPECT_EQ(block({6, 6, kGroundHeight + 4}), contentBlock("bricks"));
    EXPECT_EQ(block({7, 6, kGroundHeight + 4}), world::kAir);
    EXPECT_EQ(fill(kCube, "bricks").changed, 0u) << "no step";
    EXPECT_EQ(session_.undoOrRedo(kBuilder, HistoryWay::Undo).blocks, 125u);
    EXPECT_EQ(block(kCube.low), world::kAir);
    EXPECT_EQ(session_.undoOrRedo(kBuilder, HistoryWay::Redo).blocks, 125u);
    EXPECT_EQ(block(kCube.low), contentBlock("bricks"));
}

TEST_F(BuildTest, OnlyBlocksOfOneTypeAreReplaced) {
    fill(kCube, "bricks");
    put({3, 3, kGroundHeight + 1}, "glass");
    const BlockBox wide{{0, 0, kGroundHeight - 1}, {9, 9, kGroundHeight + 9}};
    EXPECT_EQ(fill(wide, "sand", contentBlock("bricks")).changed, 124u);
    EXPECT_EQ(block({3, 3, kGroundHeight + 1}), contentBlock("glass"));
    EXPECT_EQ(block({0, 0, kGroundHeight - 1}), contentBlock("stone"));
}

TEST_F(BuildTest, AShapeIsFilledReplacedAndTakenBackLikeABox) {
    const auto build = [&](ShapeKind kind, std::string_view name,
                           std::optional<world::BlockId> replaced = {}) {
        return session_.build({kBuilder, FillBox{kCube, contentBlock(name), 0, replaced, {kind}}}).changed;
    };
    const auto undo = [&] { return session_.undoOrRedo(kBuilder, HistoryWay::Undo).blocks; };
    EXPECT_EQ(build(ShapeKind::Hollow, "bricks"), 125u - 27);
    EXPECT_EQ(block({4, 4, kGroundHeight + 2}), world::kAir);
    EXPECT_EQ(build(ShapeKind::Walls, "glass", contentBlock("bricks")), 5u * 16);
    EXPECT_EQ(block({4, 4, kGroundHeight}), contentBlock("bricks"));
    EXPECT_EQ(undo(), 80u);
    EXPECT_EQ(undo(), 98u);
    EXPECT_EQ(block(kCube.low), world::kAir);
    EXPECT_EQ(build(ShapeKind::Line, "bricks"), 5u);
    EXPECT_EQ(block(kCube.low), contentBlock("bricks"));
    EXPECT_EQ(block(kCube.high), contentBlock("bricks"));
    EXPECT_EQ(undo(), 5u);
    EXPECT_EQ(build(ShapeKind::Sphere, "bricks"), 81u);
    EXPECT_EQ(block(kCube.low), world::kAir);
    EXPECT_EQ(
        session_.build({kBuilder, FillBox{{{0, 0, 0}, {199, 199, 99}}, 1, 0, {}, {ShapeKind::Line}}}).result,
        Result::TooLarge)
        << "a shape counts as its box";
}

TEST_F(BuildTest, RefusesWhatItShould) {
    const BlockPos low{2, 2, 70};
    EXPECT_EQ(fill({low, {1, 2, 70}}, "stone").result, Result::Empty);
    EXPECT_EQ(fill({low, {2, 2, 256}}, "stone").result, Result::OutOfWorld);
    EXPECT_EQ(fill({{2, 2, -1}, low}, "stone").result, Result::OutOfWorld);
    EXPECT_EQ(fill({low, {5000, 2, 70}}, "stone").result, Result::NotLoaded);
    EXPECT_EQ(fill({{0, 0, 0}, {199, 199, 99}}, "stone").result, Result::TooLarge);
    EXPECT_EQ(fill({{INT32_MIN, INT32_MIN, 0}, {INT32_MAX, INT32_MAX, 1}}, "stone").result, Result::TooLarge);
    EXPECT_EQ(fill({{5, 5, 140}, {6, 6, 141}}, "stone").result, Result::OutOfReach);
    EXPECT_EQ(session_.build({99, FillBox{kCube, contentBlock("stone"), 0, {}}}).result, Result::OutOfReach);
    EXPECT_EQ(place({}, low).result, Result::Empty);
    EXPECT_EQ(place(copy(kCube), {INT32_MAX - 1, 2, 70}).result, Result::OutOfReach);
    EXPECT_EQ(steps(), 0u) << "nothing changed";
    session_.setPlayer(kBuilder, {.position = {5.5, 5.5, 250}});
    EXPECT_EQ(place(copy(kCube), {2, 2, 253}).result, Result::OutOfWorld);
    EXPECT_EQ(place(copy(kCube), {2, 2, 251}).result, Result::Done);
}

TEST_F(BuildTest, TheNearestBlockMustBeInReach) {
    EXPECT_DOUBLE_EQ(distanceTo({{0, 0, 0}, {9, 9, 9}}, {5, 5, 13}), 3);
    EXPECT_DOUBLE_EQ(distanceTo({{0, 0, 0}, {9, 9, 9}}, {5, 5, 5}), 0);
    EXPECT_EQ(fill({{5, 5, 100}, {5, 5, 200}}, "stone").result, Result::Done);
}

TEST_F(BuildTest, NoPlayerFillsTheLowestLayer) {
    session_.setPlayer(kBuilder, {.position = {5.5, 5.5, 3}});
    const BuildOutcome outcome = fill({{2, 2, 0}, {3, 3, 2}}, "air");
    EXPECT_EQ(outcome.changed, 8u);
    EXPECT_EQ(outcome.skipped, 4u);
    EXPECT_EQ(block({2, 2, 0}), contentBlock("stone"));
    const FillBox all{{{2, 2, 0}, {3, 3, 2}}, world::kAir, 0, {}};
    EXPECT_EQ(session_.build({kNoPlayer, all}).changed, 4u) << "a script may";
}

// Blocks on the box, beside it and falling into it react.
TEST_F(BuildTest, NeighborsAreTold) {
    put({3, 3, kGroundHeight}, "dirt");
    put({3, 3, kGroundHeight + 1}, "poppy");
    put({4, 4, kGroundHeight}, "stone");
    put({4, 4, kGroundHeight + 1}, "sand");
    put({5, 6, kGroundHeight}, "oak_fence");
    fill({{3, 3, kGroundHeight}, {5, 5, kGroundHeight}}, "air");
    EXPECT_EQ(block({3, 3, kGroundHeight + 1}), world::kAir) << "the poppy lost its ground";
    EXPECT_EQ(block({4, 4, kGroundHeight}), contentBlock("sand")) << "it fell";
    fill({{5, 5, kGroundHeight}, {5, 5, kGroundHeight}}, "stone");
    EXPECT_EQ(session_.world().blockState({5, 6, kGroundHeight}) >> world::kStateArmShift,
              1 << world::kFaceNegY)
        << "an arm toward the stone";
}

TEST_F(BuildTest, FencesInsideOfAFillHaveArms) {
    fill({{2, 2, kGroundHeight}, {4, 4, kGroundHeight + 2}}, "oak_fence");
    EXPECT_EQ(session_.world().blockState({3, 3, kGroundHeight + 1}) >> world::kStateArmShift, 15);
    EXPECT_EQ(session_.world().blockState({2, 3, kGroundHeight + 1}) >> world::kStateArmShift, 14);
}

// Random boxes against a slow reference.
TEST_F(BuildTest, RandomFillsAreThoseOfAPlainMap) {
    constexpr const char* kNames[] = {"stone", "bricks", "glass", "air"};
    const BlockBox whole{{0, 0, kGroundHeight - 4}, {11, 11, kGroundHeight + 7}};
    std::map<BlockPos, world::BlockId> plain;
    for (std::int64_t n = 0; n < whole.blockCount(); ++n) plain[whole.blockAt(n)] = block(whole.blockAt(n));
    std::mt19937 random(1);
    const auto corner = [&] { return whole.blockAt(static_cast<std::int64_t>(random() % 1728)); };
    for (int round = 0; round < 60; ++round) {
        const BlockPos a = corner(), b = corner();
        const BlockBox box{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                           {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
        const world::BlockId id = contentBlock(kNames[random() % 4]);
        const std::optional<world::BlockId> replaced =
            random() % 2 == 0 ? std::optional(contentBlock(kNames[random() % 4])) : std::nullopt;
        std::size_t changed = 0;
        for (std::int64_t n = 0; n < box.blockCount(); ++n) {
            world::BlockId& there = plain[box.blockAt(n)];
            if (there == id || (replaced && there != *replaced)) continue;
            there = id;
            ++changed;
        }
        ASSERT_EQ(session_.build({kBuilder, FillBox{box, id, 0, replaced}}).changed, changed);
    }
    for (const auto& [pos, id] : plain) ASSERT_EQ(block(pos), id);
    while (session_.undoOrRedo(kBuilder, HistoryWay::Undo).outcome == UndoResult::Outcome::Done) {
    }
    for (const auto& [pos, id] : plain)
        ASSERT_EQ(block(pos), pos.z < kGroundHeight ? contentBlock("stone") : world::kAir);
}

TEST_F(BuildTest, ACopyGoesThroughAFileAndIsPlacedWithItsData) {
    const BlockBox room{{2, 2, kGroundHeight}, {5, 4, kGroundHeight + 2}};
    fill(room, "bricks");
    put({3, 3, kGroundHeight}, "chest");
    put({4, 3, kGroundHeight}, "sign", 2);
    const auto text = world::encodeSign({"hello", "", "", "there"});
    session_.edit({kNoPlayer, {4, 3, kGroundHeight}, world::SetEntityData{text}, std::nullopt});
    world::Inventory things(27);
    things[3] = {"sand", 9};
    session_.edit(
        {kNoPlayer, {3, 3, kGroundHeight}, world::SetEntityData{world::encodeInventory(things)}, {}});
    put({5, 4, kGroundHeight + 2}, "oak_stairs", 5);
    const world::Structure before = copy(room);
    const auto read = store::decodeStructure(*store::encodeStructure(before));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(place(*read, {8, 2, kGroundHeight}).result, Result::Done);
    EXPECT_TRUE(copy({{8, 2, kGroundHeight}, {11, 4, kGroundHeight + 2}}) == before);
    EXPECT_EQ(session_.world().blockState({10, 3, kGroundHeight}), 2);
    const auto turned = world::turnedStructure(*read, session_.blocks(), 1);
    EXPECT_EQ(place(turned, {2, 8, kGroundHeight}).result, Result::Done);
    EXPECT_TRUE(copy({{2, 8, kGroundHeight}, {4, 11, kGroundHeight + 2}}) == turned);
    session_.undoOrRedo(kBuilder, HistoryWay::Undo);
    session_.undoOrRedo(kBuilder, HistoryWay::Undo);
    EXPECT_EQ(block({8, 2, kGroundHeight}), world::kAir);
    EXPECT_TRUE(copy(room) == before);
}

TEST_F(BuildTest, AContainerThatIsFilledOverComesBackWithItsThings) {
    const BlockPos pos{3, 3, kGroundHeight};
    put(pos, "chest");
    const auto things = world::encodeInventory(world::Inventory(27, {"sand", 9}));
    session_.edit({kNoPlayer, pos, world::SetEntityData{things}, std::nullopt});
    fill(kCube, "air");
    EXPECT_EQ(block(pos), world::kAir);
    session_.undoOrRedo(kBuilder, HistoryWay::Undo);
    EXPECT_EQ(block(pos), contentBlock("chest"));
    ASSERT_TRUE(session_.world().blockEntityData(pos));
    EXPECT_EQ(*session_.world().blockEntityData(pos), things);
}

TEST_F(BuildTest, InventoriesOfStructuresGetTheSlotsOfTheirBlock) {
    world::Inventory many(301), few(1, {"sand", 9}), full(28, {"sand", 500});
    many[300] = {"stone", 1};
    world::Structure structure{
        .size = {4, 1, 1}, .palette = {{"chest", 0}}, .cells = {0, 0, 0, 0}, .data = {}};
    std::uint32_t cell = 0;
    for (const world::BlockEntityData& data : {world::encodeInventory(many), world::encodeInventory(few),
                                               world::encodeInventory(full), world::BlockEntityData(9)})
        structure.data.push_back({cell++, std::make_shared<const world::BlockEntityData>(data)});
    EXPECT_EQ(place(structure, {3, 3, kGroundHeight}).result, Result::Done);
    const auto itemsAt = [&](int x) {
        const world::BlockEntityData* data = session_.world().blockEntityData({x, 3, kGroundHeight});
        return data ? world::decodeSlots(*data).value() : world::Inventory();
    };
    const auto countOf = [&](int x, std::string_view item) {
        int count = 0;
        for (const world::ItemStack& stack : itemsAt(x)) count += stack.item == item ? stack.count : 0;
        return count;
    };
    for (const auto& [x, count] : {std::pair(3, 1), {4, 9}, {5, 27 * 99}}) {
        EXPECT_EQ(itemsAt(x).size(), 27u);
        EXPECT_EQ(countOf(x, x == 3 ? "stone" : "sand"), count);
    }
    EXPECT_EQ(itemsAt(6), world::Inventory()) << "no inventory";
}

TEST_F(BuildTest, UnknownNamesAreMissingAndTextThatIsNoneIsLeftOut) {
    world::Structure structure{
        .size = {2, 1, 1}, .palette = {{"moon_cheese", 0}, {"sign", 1}}, .cells = {0, 1}, .data = {}};
    structure.data.push_back({1, std::make_shared<const world::BlockEntityData>(9, std::byte{1})});
    place(structure, {3, 3, kGroundHeight});
    EXPECT_EQ(block({3, 3, kGroundHeight}), session_.blocks().missing());
    EXPECT_EQ(block({4, 3, kGroundHeight}), contentBlock("sign"));
    EXPECT_FALSE(session_.world().blockEntityData({4, 3, kGroundHeight}));
}

TEST_F(BuildTest, LightAfterALargeFillIsThatFromScratch) {
    std::map<world::ChunkPos, light::ChunkLightPtr> shown;
    const BlockBox box{{-13, -13, kGroundHeight - 10}, {28, 28, kGroundHeight + 20}};
    for (const char* name : {"lamp_red", "stone", "glass", "air"}) {
        ASSERT_EQ(fill(box, name).result, Result::Done);
        settle();
        expectLightFromScratch(shown);
    }
    while (session_.undoOrRedo(kBuilder, HistoryWay::Undo).outcome == UndoResult::Outcome::Done) {
        settle();
        expectLightFromScratch(shown);
    }
}

// The text of a sign is a separate step, and comes back with the sign.
TEST_F(BuildTest, TextOfASignIsUndone) {
    const BlockPos pos{5, 5, kGroundHeight};
    const auto say = [&](const world::BlockEntityData& data) {
        return session_.edit({kBuilder, pos, world::SetEntityData{data}, std::nullopt});
    };
    session_.edit({kBuilder, pos, world::SetBlock{contentBlock("sign"), 3}, std::nullopt});
    const auto text = world::encodeSign({"one", "two", "", ""});
    EXPECT_EQ(say(text), EditResult::Applied);
    EXPECT_EQ(say(world::BlockEntityData(20)), EditResult::BadData);
    EXPECT_EQ(session_.world().blockState(pos), 3) << "it faces as before";
    session_.edit({kBuilder, pos, world::SetBlock{world::kAir}, std::nullopt});
    session_.undoOrRedo(kBuilder, HistoryWay::Undo);
    EXPECT_EQ(block(pos), contentBlock("sign"));
    EXPECT_EQ(session_.world().blockState(pos), 3);
    ASSERT_TRUE(session_.world().blockEntityData(pos));
    EXPECT_EQ(*session_.world().blockEntityData(pos), text);
    session_.undoOrRedo(kBuilder, HistoryWay::Undo);
    EXPECT_FALSE(session_.world().blockEntityData(pos));
    session_.undoOrRedo(kBuilder, HistoryWay::Undo);
    EXPECT_EQ(block(pos), world::kAir);
}

TEST_F(BuildTest, AStructureThatIsNoneIsNotPlaced) {
    const BlockPos low{2, 2, kGroundHeight};
    EXPECT_EQ(session_.build({kBuilder, PlaceStructure{nullptr, low}}).result, Result::Empty);
    world::Structure cells = copy(kCube), palette = cells;
    cells.cells.pop_back();
    EXPECT_THROW(place(cells, low), std::invalid_argument);
    palette.cells.front() = static_cast<std::uint32_t>(palette.palette.size());
    EXPECT_THROW(place(palette, low), std::invalid_argument);
    EXPECT_EQ(steps(), 0u);
}

}  // namespace
}  // namespace terrane::game
