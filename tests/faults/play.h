// Simulates a program that opens a save, edits, saves, loads and closes it while faults occur, and checks the
// save afterwards.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/faults/ledger.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {

// A chunk marked with a number.
world::ChunkPtr markedChunk(int content);
// The number of a chunk: 0 if there is none, -1 for other chunks.
int contentOf(const LoadedChunk& loaded);

// Contents of the folder before the play.
struct Start {
    std::map<std::string, std::string> files;  // content by name
    Ledger ledger;
    int damaged = 0;  // number of damaged rows
};
Start emptyFolder();
Start saveOfFormat1();
Start saveWithDamagedRows();
Start saveAfterKill();  // the last transactions are only in the log

class Play {
  public:
    Play(const base::TempFolder& folder, const Start& start);

    // Edits, saves and loads twice, with a restart in between. Answers of the store must be right even during
    // faults; it may refuse once per failure, unless the failure `lasts`.
    void run(bool lasts);
    // Without faults: durable saves exist, the save is intact and usable.
    void verify();

    bool reportsAll = true;  // the play completed without a refusal

  private:
    std::unique_ptr<SqliteStore> open();
    void session(SqliteStore& store);
    void save(SqliteStore& store, world::ChunkPos pos);
    void flush(SqliteStore& store);
    void expectLoads(SqliteStore& store);
    void expectGoodCheck(bool mayBeUndone) const;

    std::filesystem::path path_;
    world::BlockRegistry registry_ = testRegistry();
    Ledger ledger_;
    int damaged_ = 0, content_ = 1000;
    bool lasts_ = false;
};

}  // namespace terrane::store
