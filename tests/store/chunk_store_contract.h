// The contract of every ChunkStore is tested by chunk_store_contract_test.cpp. A kind of store takes part by
// a fixture and a line in store_kinds_test.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tests/store/store_fixture.h"

namespace terrane::store {

// A world with kIdentity, new for each test, and the environment of the kind of store: a folder, a database.
class ContractWorld {
  public:
    virtual ~ContractWorld() = default;
    // Opens the world with testRegistry() and no automatic saves (kNever). When called again, the previous
    // store is gone; a persistent store finds its saves.
    virtual std::unique_ptr<ChunkStore> open() = 0;
};

struct StoreKind {
    std::string name;  // name of the tests
    std::function<std::unique_ptr<ContractWorld>()> makeWorld;
};

class ChunkStoreContract : public testing::TestWithParam<StoreKind> {
  protected:
    std::unique_ptr<ContractWorld> world_ = GetParam().makeWorld();
};

}  // namespace terrane::store
