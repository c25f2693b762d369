// What every ChunkStore does is in chunk_store_contract_test.cpp. A kind of store takes part by a fixture
// and a line in store_kinds_test.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tests/store/store_fixture.h"

namespace terrane::store {

// A world of kIdentity, new for each test, and what a store of the kind needs besides: a folder, a database.
class ContractWorld {
  public:
    virtual ~ContractWorld() = default;
    // The world with testRegistry(), saving nothing by itself (kNever). Called again after the store before
    // is gone: where the store is persistent it finds what that one saved.
    virtual std::unique_ptr<ChunkStore> open() = 0;
};

struct StoreKind {
    std::string name;  // of the tests
    std::function<std::unique_ptr<ContractWorld>()> makeWorld;
};

class ChunkStoreContract : public testing::TestWithParam<StoreKind> {
  protected:
    std::unique_ptr<ContractWorld> world_ = GetParam().makeWorld();
};

}  // namespace terrane::store
