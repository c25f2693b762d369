// A program that opens a save, edits, saves, loads and closes it, while the world around it fails; and what
// must be true of the save afterwards.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "terrane/store/sqlite_store.h"
#include "tests/faults/ledger.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {

// A chunk that tells which save it is from.
world::ChunkPtr markedChunk(int content);
// -1: another chunk; 0 where there is none.
int contentOf(const LoadedChunk& loaded);

// What a folder holds before the play begins.
struct Start {
    std::map<std::string, std::string> files;  // content by name
    Ledger ledger;
    int damaged = 0;  // rows
};
Start emptyFolder();
Start saveOfFormat1();
Start saveWithDamagedRows();
Start saveAfterKill();  // its last transactions are in the log alone

class Play {
  public:
    Play(const base::TempFolder& folder, const Start& start);

    // Edits, saves and loads twice, with a restart between. What the store answers must be right, also while
    // the disk fails; it may refuse, once for each failure unless failing `lasts`.
    void run(bool lasts);
    // Nothing fails any more: what was durable is there, the save is whole and works.
    void verify();

    bool tellsAll = true;  // the play got through without a refusal

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
