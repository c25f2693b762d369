#include "terrane/net/server/edit_log.h"

#include <random>

#include "tests/net/bytes_of.h"
#include "tests/net/server_file_fixture.h"

namespace terrane::net {
namespace {

using game::PlayerId;
using world::BlockPos;

world::BlockValue valueOf(std::string_view name, int state = 0) {
    return {contentBlock(name), static_cast<std::uint16_t>(state), {}};
}

class EditLogTest : public RecordsTest {
  protected:
    void log(PlayerId player, std::int64_t timeMs, const std::vector<game::ChangedBlock>& changes) {
        const std::vector<LoggedEdit> edits = loggedEdits(next_, {player}, timeMs, changes);
        records_->append(edits);
        next_ = edits.back().number + 1;
    }
    std::vector<LoggedEdit> found(const EditFilter& filter, EditOrder order = EditOrder::OldestFirst) {
        flush();
        std::vector<LoggedEdit> edits;
        const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
            edits.push_back(edit);
            return {};
        };
        const auto done = records_->forEachEdit(filter, order, take);
        EXPECT_TRUE(done) << done.error().message;
        return edits;
    }
    std::vector<game::ChangedBlock> plan(const EditFilter& filter) {
        flush();
        const auto forEachEdit = [&](const EditFilter& wanted, EditOrder order, const UseEdit& use) {
            return records_->forEachEdit(wanted, order, use);
        };
        return rollback(forEachEdit, filter).value();
    }

    std::int64_t next_ = 1;
};

TEST_F(EditLogTest, AnEditOfNoBlocksIsDamaged) {
    const store::BlockIdMap ids = store::BlockIdMap::make(contentBlocks(), {}).value();
    const Bytes blocks = encodeEdit(LoggedEdit(), ids);
    EXPECT_FALSE(decodeEdit(EditRow{.number = 3, .blocks = blocks}, ids));
}

TEST_F(EditLogTest, AnEditReadsBack) {
    world::BlockValue chest = valueOf("chest", 3);
    chest.data = std::make_shared<const world::BlockEntityData>(40, std::byte{5});
    log(7, 1000, {{{5, -6, 70}, valueOf("air"), chest}, {{5, -6, 71}, valueOf("sand"), valueOf("glass")}});
    const auto edits = found({});
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_EQ(edits[0].number, 1);
    EXPECT_EQ(edits[0].timeMs, 1000);
    EXPECT_EQ(edits[0].player, 7u);
    EXPECT_EQ(edits[0].chunk, (world::ChunkPos{0, -1}));
    ASSERT_EQ(edits[0].after.size(), 2u);
    EXPECT_EQ(edits[0].after[0].value, chest);
    EXPECT_EQ(edits[0].before[1].value, valueOf("sand"));
}

TEST_F(EditLogTest, EditsOfAllHeightsReadBack) {
    world::BlockValue chest = valueOf("chest", 3);
    chest.data = std::make_shared<const world::BlockEntityData>(40, std::byte{5});
    const std::vector<game::ChangedBlock> changes{{{5, -6, -2048}, valueOf("air"), chest},
                                                  {{5, -6, -1}, valueOf("sand"), valueOf("glass")},
                                                  {{5, -6, 70}, valueOf("air"), valueOf("sand")},
                                                  {{5, -6, 2047}, chest, valueOf("air")}};
    log(7, 1000, changes);
    const auto edits = found({});
    ASSERT_EQ(edits.size(), 1u);
    for (std::size_t k = 0; k < changes.size(); ++k) {
        EXPECT_EQ(world::blockPos(edits[0].chunk, edits[0].after[k].index), changes[k].pos);
        EXPECT_EQ(edits[0].before[k].value, changes[k].before);
        EXPECT_EQ(edits[0].after[k].value, changes[k].after);
    }
    const auto back = plan({.area = game::ColumnArea{5, -6, 5, -6}});
    ASSERT_EQ(back.size(), 4u);
    EXPECT_EQ(back[0].pos, changes[0].pos);
    EXPECT_EQ(back[3].before, chest);
}

// Programs that know only 0…255 read these.
TEST_F(EditLogTest, EditsWithin256LayersKeepTheirBytes) {
    const store::BlockIdMap ids = store::BlockIdMap::make(contentBlocks(), {}).value();
    const auto bytesAt = [&](std::int32_t z) {
        const std::vector<game::ChangedBlock> changes{{{1, 0, z}, valueOf("air"), valueOf("air", 1)}};
        return encodeEdit(loggedEdits(1, {7}, 1000, changes).at(0), ids);
    };
    EXPECT_EQ(bytesAt(0), bytesOf({1, 0, 0, 1, 2, 0, 1, 0, 1, 1, 2, 0}));
    EXPECT_EQ(bytesAt(255)[0], std::byte{1});
    for (const std::int32_t z : {-1, 256}) EXPECT_EQ(bytesAt(z)[0], std::byte{0}) << z;
}

// Three blocks with the maximum of data exceed one part.
TEST_F(EditLogTest, MuchDataReadsBack) {
    world::BlockValue chest = valueOf("chest");
    chest.data = std::make_shared<const world::BlockEntityData>(kMaxBlockData, std::byte{5});
    std::vector<game::ChangedBlock> changes;
    for (int k = 0; k < 7; ++k) changes.push_back({{k, 0, 70}, chest, valueOf("air")});
    log(7, 1000, changes);
    std::size_t blocks = 0;
    for (const LoggedEdit& edit : found({})) blocks += edit.before.size();
    EXPECT_EQ(blocks, 7u);
    EXPECT_EQ(plan({}).size(), 7u);
}

TEST_F(EditLogTest, EachChunkHasItsOwn) {
    std::vector<game::ChangedBlock> changes;
    for (int x = -40; x < 40; ++x)
        for (int y = 0; y < 3; ++y)
            for (int z = 0; z < 250; ++z) changes.push_back({{x, y, z}, valueOf("air"), valueOf("stone")});
    log(7, 1, changes);
    std::size_t blocks = 0;
    for (const LoggedEdit& edit : found({})) {
        blocks += edit.after.size();
        EXPECT_LE(edit.after.size(), kMaxBlocksInPart);
    }
    EXPECT_EQ(blocks, changes.size());
}

TEST_F(EditLogTest, IsFilteredByPlayerAreaAndTime) {
    log(7, 100, {{{0, 0, 70}, valueOf("air"), valueOf("glass")}});
    log(8, 200, {{{100, 0, 70}, valueOf("air"), valueOf("glass")}});
    log(7, 300, {{{15, 15, 70}, valueOf("air"), valueOf("glass")}});
    const auto numbers = [&](const EditFilter& filter, EditOrder order = EditOrder::OldestFirst) {
        std::vector<std::int64_t> all;
        for (const LoggedEdit& edit : found(filter, order)) all.push_back(edit.number);
        return all;
    };
    using Numbers = std::vector<std::int64_t>;
    EXPECT_EQ(numbers({}), (Numbers{1, 2, 3}));
    EXPECT_EQ(numbers({}, EditOrder::NewestFirst), (Numbers{3, 2, 1}));
    EXPECT_EQ(numbers({.player = 7}), (Numbers{1, 3}));
    EXPECT_EQ(numbers({.area = game::ColumnArea{90, -5, 110, 5}}), (Numbers{2}));
    EXPECT_EQ(numbers({.area = game::ColumnArea{0, 0, 14, 20}}), (Numbers{1}))
        << "the chunk alone is not enough";
    EXPECT_EQ(numbers({.beforeMs = 200}), (Numbers{1}));
    EXPECT_EQ(numbers({.afterNumber = 2}), (Numbers{3}));
    EXPECT_EQ(records_->historyEnds()->newest, 3);
}

// The clock was wrong for some edits: the last edits are those with the greatest numbers.
TEST_F(EditLogTest, TheLastEditsFollowFromTheirOrder) {
    const std::int64_t right = 1'000'000, hour = 3'600'000, year = 365 * 24 * hour;
    for (const std::int64_t time :
         {right, right + year, right + 1000, right - hour, right + 2000, right + 3000})
        log(7, time, {{{0, 0, 70}, valueOf("air"), valueOf("glass")}});
    const auto since = [&](std::int64_t timeMs, EditFilter filter = {}) {
        const auto forEachEdit = [&](const EditFilter& wanted, EditOrder order, const UseEdit& use) {
            return records_->forEachEdit(wanted, order, use);
        };
        flush();
        EXPECT_TRUE(selectSince(filter, forEachEdit, timeMs));
        std::vector<std::int64_t> numbers;
        for (const LoggedEdit& edit : found(filter)) numbers.push_back(edit.number);
        return numbers;
    };
    using Numbers = std::vector<std::int64_t>;
    EXPECT_EQ(since(right + 2500), (Numbers{6}));
    EXPECT_EQ(since(right + 1500), (Numbers{5, 6})) << "not those of the next year";
    EXPECT_EQ(since(right + 1000), (Numbers{5, 6})) << "one with an earlier date lies between";
    EXPECT_EQ(since(right - 2 * hour), (Numbers{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(since(right - 2 * hour, {.afterNumber = 4}), (Numbers{5, 6}));
    EXPECT_TRUE(since(right + 4000).empty());
}

TEST_F(EditLogTest, RemembersWhatTheWorldHas) {
    EXPECT_EQ(records_->historyEnds()->saved, 0);
    records_->setSavedEdit(5);
    records_->setSavedEdit(9);
    flush();
    EXPECT_EQ(records_->historyEnds()->saved, 9);
}

// A rollback goes from the value after the last selected edit to the value before the first.
TEST_F(EditLogTest, ARollbackSpansAllEditsOfABlock) {
    const BlockPos pos{1, 2, 70};
    log(7, 100, {{pos, valueOf("air"), valueOf("glass")}});
    log(8, 200, {{pos, valueOf("glass"), valueOf("sand")}});
    log(8, 300, {{pos, valueOf("sand"), valueOf("stone")}, {{50, 2, 70}, valueOf("air"), valueOf("stone")}});
    const auto all = plan({.player = 8});
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].pos, pos);
    EXPECT_EQ(all[0].after, valueOf("stone"));
    EXPECT_EQ(all[0].before, valueOf("glass"));
    const auto inArea = plan({.player = 8, .area = game::ColumnArea{40, 0, 60, 9}});
    ASSERT_EQ(inArea.size(), 1u);
    EXPECT_EQ(inArea[0].pos, (BlockPos{50, 2, 70}));
    EXPECT_EQ(plan({.player = 8, .afterNumber = 2})[0].before, valueOf("sand"));
    EXPECT_TRUE(plan({.player = 9}).empty());
}

// Random edits of several players: the rollback of one equals a slow reference.
TEST_F(EditLogTest, RollbacksEqualAReference) {
    std::mt19937 random(4);
    const std::vector<std::string> names{"air", "stone", "sand", "glass", "dirt"};
    std::map<BlockPos, std::string> world;
    struct Entry {
        PlayerId player;
        BlockPos pos;
        std::string before, after;
    };
    std::vector<Entry> entries;
    for (int k = 0; k < 400; ++k) {
        const BlockPos pos{static_cast<int>(random() % 6), 0, 70};
        const PlayerId player = 7 + random() % 3;
        std::string& there = world.try_emplace(pos, "air").first->second;
        const std::string next = names[random() % names.size()];
        log(player, k, {{pos, valueOf(there), valueOf(next)}});
        entries.push_back({player, pos, there, next});
        there = next;
    }
    for (PlayerId player = 7; player < 10; ++player) {
        std::map<BlockPos, std::pair<std::string, std::string>> expected;  // before, made
        for (const Entry& entry : entries) {
            if (entry.player != player) continue;
            expected.try_emplace(entry.pos, entry.before, "").first->second.second = entry.after;
        }
        const auto found = plan({.player = player});
        ASSERT_EQ(found.size(), expected.size());
        for (const game::ChangedBlock& block : found) {
            EXPECT_EQ(block.before, valueOf(expected[block.pos].first));
            EXPECT_EQ(block.after, valueOf(expected[block.pos].second));
        }
    }
}

// The file stores block names: a program with other types reads it correctly, and refuses unknown ones.
TEST_F(EditLogTest, BlockTypesAreNamed) {
    log(7, 1, {{{0, 0, 70}, valueOf("air"), valueOf("glass")}});
    flush();
    const auto fewer = world::BlockRegistry::parse(
        "[[block]]\nname = \"glass\"\nshape = \"cube\"\ntexture = \"stone\"\n", "test");
    open(*fewer);
    EXPECT_EQ(found({})[0].after[0].value.id, fewer->find("glass")->id);
}

TEST_F(EditLogTest, DamagedRowsAreRefused) {
    log(7, 1, {{{0, 0, 70}, valueOf("air"), valueOf("glass")}});
    records_->file().write(
        [](store::Database& database) { return database.execute("UPDATE edits SET blocks = x'FF00'"); });
    flush();
    const auto done = records_->forEachEdit({}, EditOrder::OldestFirst,
                                            [](const LoggedEdit&) { return base::Result<void>(); });
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, base::ErrorCode::Damaged);
}

}  // namespace
}  // namespace terrane::net
