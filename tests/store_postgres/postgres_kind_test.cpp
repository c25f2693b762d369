// PostgreSQL tested by the contract of ChunkStore.
#include "terrane/store/overlay_store.h"
#include "terrane/store_postgres/postgres_store.h"
#include "tests/store/chunk_store_contract.h"
#include "tests/store_postgres/postgres_server.h"

namespace terrane::store {
namespace {

using store_postgres::Address;
using store_postgres::PostgresStore;

std::unique_ptr<ChunkStore> openPostgres(const Address& address, const world::BlockRegistry& blocks) {
    auto store = PostgresStore::open(address, blocks, {.create = kIdentity, .decide = {}},
                                     WorldSharing::Alone, kNever);
    if (!store) throw std::runtime_error(store.error().message);
    return std::move(*store);
}

class PostgresWorld : public ContractWorld {
  public:
    std::unique_ptr<ChunkStore> open() override { return openPostgres(address_, registry_); }

  private:
    Address address_ = *store_postgres::addressOf(
        store_postgres::sharedServer().url("schema=" + store_postgres::freshSchema()));
    world::BlockRegistry registry_ = testRegistry();
};

// An overlay over a database opened for reading.
class OverlayOfPostgresWorld : public ContractWorld {
  public:
    std::unique_ptr<ChunkStore> open() override {
        openPostgres(address_, registry_);
        auto below = store_postgres::openReader(address_, registry_);
        if (!below) throw std::runtime_error(below.error().message);
        return std::make_unique<OverlayStore>(std::move(*below), kNever);
    }

  private:
    Address address_ = *store_postgres::addressOf(
        store_postgres::sharedServer().url("schema=" + store_postgres::freshSchema()));
    world::BlockRegistry registry_ = testRegistry();
};

template <class World>
StoreKind kindOf(const char* name) {
    return {name, [] { return std::make_unique<World>(); }};
}

INSTANTIATE_TEST_SUITE_P(Stores, ChunkStoreContract,
                         testing::Values(kindOf<PostgresWorld>("Postgres"),
                                         kindOf<OverlayOfPostgresWorld>("OverlayOfPostgres")),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace terrane::store
