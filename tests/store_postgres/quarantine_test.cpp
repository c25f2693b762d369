// Invalid rows are quarantined with their data.
#include <random>

#include "tests/store_postgres/world_fixture.h"

#include "terrane/store/chunks/chunk_key.h"

namespace terrane::store_postgres {
namespace {

using store::LoadedChunk;
using store::Provenance;
using testing::HasSubstr;
using State = LoadedChunk::State;

class QuarantineTest : public PostgresWorldTest {
  protected:
    static std::string whereIs(world::ChunkPos pos) {
        return fmt::format(" WHERE key = {}", store::keyOf(pos));
    }
    std::string countIn(const std::string& tableAndCondition) {
        return query("SELECT count(*) FROM " + tableAndCondition);
    }
    void expectDamaged(const LoadedChunk& loaded, world::ChunkPos pos, const std::string& problem) {
        EXPECT_EQ(loaded.state, State::Damaged) << problem;
        EXPECT_FALSE(loaded.isUnreadable);
        EXPECT_EQ(loaded.chunk, nullptr);
        EXPECT_THAT(loaded.problem, HasSubstr(address_.shown + ": " + store::nameOf(pos) + ": " + problem));
        EXPECT_EQ(loaded.problem.find('\n'), std::string::npos);
    }
    void save(world::ChunkPos pos, int number, Provenance provenance = Provenance::Edited) {
        const auto store = open();
        store->save(pos, store::numberedChunk(number), provenance);
        ASSERT_TRUE(store->flush());
    }
};

struct Damage {
    const char *change, *problem;
};
constexpr Damage kDamages[] = {
    {"data = ''", "0 bytes are too few"},
    {"data = '\\x0102'", "2 bytes are too few"},
    {"data = substr(data, 1, length(data) - 1)", "the checksum is wrong"},
    {"data = data || '\\x00'", "the checksum is wrong"},
    {"data = set_byte(data, 20, get_byte(data, 20) # 1)", "the checksum is wrong"},
    {"origin = 0", "the checksum is wrong"},
    {"key = key + 1", "the checksum is wrong"},
    {"data = convert_to(repeat('x', 66 << 20), 'UTF8')", "longer than a chunk can be"},
};

// Chunks x,0 are damaged, each in a different way.
TEST_F(QuarantineTest, DamagedRowIsQuarantined) {
    constexpr int kCount = static_cast<int>(std::size(kDamages));
    makeWorld(kCount + 1);
    sql("ALTER TABLE chunks ALTER data SET STORAGE EXTENDED");  // compresses long values
    std::vector<world::ChunkPos> positions;
    std::vector<std::string> before;
    for (int x = 0; x < kCount; ++x) {
        const std::string change = kDamages[x].change;
        sql("UPDATE chunks SET " + change + whereIs({x, 0}));
        positions.push_back({x, change.starts_with("key") ? 1 : 0});
        before.push_back(query("SELECT md5(data) FROM chunks" + whereIs(positions.back())));
    }
    {
        const auto store = open();
        for (int x = 0; x < kCount; ++x)
            expectDamaged(store->load(positions[x]), positions[x], kDamages[x].problem);
        EXPECT_EQ(store->load({kCount, 0}).state, State::Present);
        ASSERT_TRUE(store->flush());
        for (const world::ChunkPos pos : positions) {
            EXPECT_EQ(store->load(pos).state, State::Absent) << "to be generated";
            store->save(pos, store::numberedChunk(100), Provenance::Generated);
        }
        ASSERT_TRUE(store->flush());
        for (const auto& loaded : store->loadMany(positions))
            EXPECT_EQ(*loaded.chunk, *store::numberedChunk(100));
    }
    for (int x = 0; x < kCount; ++x)
        EXPECT_EQ(query("SELECT string_agg(md5(data), ' ') FROM quarantine" + whereIs(positions[x])),
                  before[x]);
    EXPECT_EQ(countIn("quarantine"), std::to_string(kCount));
    EXPECT_EQ(countIn("chunks"), std::to_string(kCount + 1));
}

// Saving without loading does not overwrite data that could still be recovered.
TEST_F(QuarantineTest, DamagedRowIsQuarantinedAlsoWhenNobodyLooked) {
    for (const Provenance provenance : {Provenance::Generated, Provenance::Edited}) {
        save({0, 0}, 1);
        sql("UPDATE chunks SET data = '\\x0102'");
        save({0, 0}, 2, provenance);
        EXPECT_EQ(*open()->load({0, 0}).chunk, *store::numberedChunk(2));
        EXPECT_EQ(countIn("quarantine WHERE data = '\\x0102'"), "1");
        sql("DELETE FROM quarantine");
    }
}

// Many signs: the row is longer than those that are read together.
TEST_F(QuarantineTest, ALongRowIsNotDamaged) {
    auto chunk = std::make_shared<world::Chunk>(*store::numberedChunk(1));
    std::mt19937 random(1);
    for (int n = 0; n < 3000; ++n) {
        chunk->setBlockEntityData(world::blockIndex(n % 16, n / 16 % 16, n / 256),
                                  store::randomBytes(random, 200));
    }
    for (const int number : {1, 2}) {
        const auto store = open();
        chunk->setBlockState(world::blockIndex(1, 1, 20), static_cast<std::uint16_t>(number));
        store->save({0, 0}, std::make_shared<world::Chunk>(*chunk), Provenance::Edited);
        ASSERT_TRUE(store->flush());
    }
    EXPECT_GT(std::stoi(query("SELECT octet_length(data) FROM chunks" + whereIs({0, 0}))), 262144);
    EXPECT_EQ(countIn("quarantine"), "0");
    EXPECT_TRUE(*open()->load({0, 0}).chunk == *chunk);
}

// Such a row is damaged. It must not remain after an edit was reported as saved.
TEST_F(QuarantineTest, AnEditReplacesARowOfAnyOrigin) {
    save({0, 0}, 1);
    sql("ALTER TABLE chunks DROP CONSTRAINT chunks_origin_check");
    for (const char* origin : {"2", "143", "-1"}) {
        sql(std::string("UPDATE chunks SET origin = ") + origin);
        EXPECT_THAT(open()->load({0, 0}).problem, HasSubstr(std::string("its origin is ") + origin));
        save({0, 0}, 3);
        EXPECT_TRUE(*open()->load({0, 0}).chunk == *store::numberedChunk(3)) << origin;
    }
}

// Damage in one row does not affect the others of a batch.
TEST_F(QuarantineTest, LoadsManyAroundDamagedRows) {
    makeWorld(10);
    sql("UPDATE chunks SET data = decode(repeat('00', 60), 'hex')" + whereIs({4, 0}));
    std::vector<world::ChunkPos> positions;
    for (int x = 0; x < 10; ++x) positions.push_back({x, 0});
    const auto store = open();
    const auto many = store->loadMany(positions);
    for (int x = 0; x < 10; ++x) {
        const LoadedChunk& loaded = many[static_cast<std::size_t>(x)];
        ASSERT_EQ(loaded.state, x == 4 ? State::Damaged : State::Present) << x;
        EXPECT_TRUE(x == 4 || *loaded.chunk == *store::numberedChunk(x));
    }
    EXPECT_THAT(many[4].problem, HasSubstr("chunk 4,0: the checksum is wrong"));
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(countIn("quarantine WHERE reason = 'the checksum is wrong'"), "1");
    EXPECT_EQ(store->load({4, 0}).state, State::Absent);
}

TEST_F(QuarantineTest, DamageOfAHigherLevelIsNamed) {
    save({5, -6, 2}, 1);
    sql("UPDATE chunks SET data = decode(repeat('00', 60), 'hex')");
    const auto store = open();
    EXPECT_EQ(store->load({5, -6}).state, State::Absent);
    EXPECT_THAT(store->load({5, -6, 2}).problem, HasSubstr(": chunk 5,-6 of level 2: the checksum"));
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(countIn("quarantine" + whereIs({5, -6, 2})), "1");
}

TEST_F(QuarantineTest, IdWithoutANameIsDamage) {
    save({0, 0}, 1);
    sql("DELETE FROM blocks WHERE name = 'dirt'");
    // The id goes to the next new type, so the registry must lack the name, too.
    registry_ = store::registryOf({"stone", "grass", "sand", "water"});
    EXPECT_THAT(open()->load({0, 0}).problem, HasSubstr("block id 2 has no name"));
    EXPECT_EQ(countIn("quarantine"), "1");
}

// A program found damage; before it quarantines the row, another one writes a valid chunk there.
TEST_F(QuarantineTest, WhatAnotherProgramRepairedStays) {
    save({0, 0}, 1);
    sql("UPDATE chunks SET data = '\\x0102'");
    const auto first = open(store::WorldSharing::Servers), second = open(store::WorldSharing::Servers);
    EXPECT_EQ(first->load({0, 0}).state, State::Damaged);
    second->save({0, 0}, store::numberedChunk(2), Provenance::Edited);
    ASSERT_TRUE(second->flush());
    ASSERT_TRUE(first->flush());
    EXPECT_EQ(*first->load({0, 0}).chunk, *store::numberedChunk(2));
    EXPECT_EQ(countIn("quarantine"), "1") << "by the second";
}

TEST_F(QuarantineTest, ReadersLeaveDamageWhereItIs) {
    save({0, 0}, 1);
    sql("UPDATE chunks SET data = '\\x0102'");
    const auto reader = openReader(address_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ((*reader)->load({0, 0}).state, State::Damaged);
    EXPECT_EQ(countIn("chunks"), "1");
    EXPECT_EQ(countIn("quarantine"), "0");
}

TEST_F(QuarantineTest, WhatNoSaveHoldsIsLeftOut) {
    const auto store = open();
    auto chunk = std::make_shared<world::Chunk>();
    chunk->setBlockEntityData(0, world::BlockEntityData(70u << 20));
    store->save({0, 0}, chunk, Provenance::Edited);
    store->save({1, 0}, store::numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->load({0, 0}).state, State::Absent);
    EXPECT_EQ(store->load({1, 0}).state, State::Present);
}

}  // namespace
}  // namespace terrane::store_postgres
