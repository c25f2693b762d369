// All kinds of stores, tested by the contract of ChunkStore. A new kind needs a fixture here.
#include "terrane/store/overlay_store.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/chunk_store_contract.h"

namespace terrane::store {
namespace {

class SqliteWorld : public ContractWorld {
  public:
    std::unique_ptr<ChunkStore> open() override {
        auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}}, kNever);
        if (!store) throw std::runtime_error(store.error().message);
        return std::move(*store);
    }

  private:
    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

class MemoryWorld : public ContractWorld {
  public:
    std::unique_ptr<ChunkStore> open() override { return std::make_unique<MemoryStore>(kIdentity, kNever); }
};

class OverlayWorld : public ContractWorld {
  public:
    std::unique_ptr<ChunkStore> open() override {
        return std::make_unique<OverlayStore>(std::make_unique<MemoryStore>(kIdentity), kNever);
    }
};

// An overlay over a file opened for reading.
class OverlayOfSqliteWorld : public ContractWorld {
  public:
    std::unique_ptr<ChunkStore> open() override {
        if (!std::filesystem::exists(path_) &&
            !SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}}))
            throw std::runtime_error("no save");
        auto below = SqliteReader::open(path_, registry_);
        if (!below) throw std::runtime_error(below.error().message);
        return std::make_unique<OverlayStore>(std::move(*below), kNever);
    }

  private:
    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

template <class World>
StoreKind kindOf(const char* name) {
    return {name, [] { return std::make_unique<World>(); }};
}

INSTANTIATE_TEST_SUITE_P(Stores, ChunkStoreContract,
                         testing::Values(kindOf<SqliteWorld>("Sqlite"), kindOf<MemoryWorld>("Memory"),
                                         kindOf<OverlayWorld>("Overlay"),
                                         kindOf<OverlayOfSqliteWorld>("OverlayOfSqlite")),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace terrane::store
