// Two servers write one chunk: a late snapshot never replaces a newer one.
#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

TEST(LateWriter, ReplacesNothingNewer) {
    const Address address = addressIn(sharedServer(), freshSchema());
    const world::BlockRegistry registry = store::testRegistry();
    const auto open = [&] {
        return PostgresStore::open(address, registry, kCreateWorld, store::WorldSharing::Servers,
                                   store::kNever)
            .value();
    };
    const auto early = open(), late = open();
    const world::ChunkPos pos{3, -4};
    early->setVersion(60);
    early->save(pos, store::numberedChunk(60), store::Provenance::Edited);
    ASSERT_TRUE(early->flush());
    // A snapshot of an older version that could not be written until now.
    late->setVersion(50);
    late->save(pos, store::numberedChunk(50), store::Provenance::Edited);
    std::size_t derived = 0;
    late->setDerivedRows({[&](std::span<const store::ChunkRow> edited, const store::ReadEdited&) {
                              derived += edited.size();
                              return std::vector<store::ChunkRow>();
                          },
                          {}});
    ASSERT_TRUE(late->flush());
    EXPECT_EQ(*early->load(pos).chunk, *store::numberedChunk(60));
    EXPECT_EQ(derived, 0u) << "no tile follows from what is not written";
    // An equal or newer version replaces it.
    for (const int version : {60, 61}) {
        late->setVersion(version);
        late->save(pos, store::numberedChunk(version + 100), store::Provenance::Edited);
        ASSERT_TRUE(late->flush());
        EXPECT_EQ(*early->load(pos).chunk, *store::numberedChunk(version + 100));
    }
    EXPECT_EQ(derived, 2u);
}

// The backup schema of a regeneration starts a new history.
TEST_F(PostgresWorldTest, EditsInABackupAreKept) {
    const world::ChunkPos pos{3, -4};
    {
        const auto store = open();
        store->setVersion(60);
        store->save(pos, store::numberedChunk(60), store::Provenance::Edited);
        ASSERT_TRUE(store->flush());
    }
    ASSERT_TRUE(tryOpen(regenerateBy(9, store::Regenerate::All)));
    address_ = addressIn(sharedServer(), schema_ + "_backup_1");
    {
        const auto backup = open();
        backup->save(pos, store::numberedChunk(61), store::Provenance::Edited);
        ASSERT_TRUE(backup->flush());
    }
    EXPECT_EQ(*open()->load(pos).chunk, *store::numberedChunk(61));
}

}  // namespace
}  // namespace terrane::store_postgres
