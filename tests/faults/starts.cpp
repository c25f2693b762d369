// Initial saves of plays.
#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "tests/faults/play.h"
#include "tests/store/tile_sums.h"

namespace terrane::store {
namespace {

std::unique_ptr<SqliteStore> openStart(const std::filesystem::path& path,
                                       const world::BlockRegistry& registry) {
    auto store = SqliteStore::open(path, registry, {.create = kIdentity, .decide = {}}, kNever);
    if (!store) throw std::runtime_error(store.error().message);
    (*store)->setDerivedRows({deriveSums, {}});
    if (!ensureDerivedRows(**store, "sums")) throw std::runtime_error("no tiles");
    return std::move(*store);
}

void fill(SqliteStore& store, Start& start) {
    for (int x = 0; x < 6; ++x) {
        store.save({x, 0}, markedChunk(x + 1), Provenance::Edited);
        start.ledger.found({x, 0}, x + 1);
    }
    if (!store.flush()) throw std::runtime_error("not saved");
}

std::map<std::string, std::string> filesIn(const base::TempFolder& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        files[entry.path().filename().string()] = readAll(entry.path());
    files.erase("a.sqlite-shm");
    return files;
}

}  // namespace

Start emptyFolder() {
    return {};
}

// Uses the SQL of docs/file-format-1.md.
Start saveOfFormat1() {
    Start start;
    const base::TempFolder folder;
    const world::BlockRegistry registry = testRegistry();
    fill(*openStart(folder / "a.sqlite", registry), start);
    runSql(folder / "a.sqlite", "DELETE FROM chunks WHERE key >= " + std::to_string(kFirstTileKey) +
                                    "; DELETE FROM settings WHERE name = 'tiles'; PRAGMA user_version = 1");
    start.files = filesIn(folder);
    return start;
}

Start saveWithDamagedRows() {
    Start start;
    const base::TempFolder folder;
    const world::BlockRegistry registry = testRegistry();
    fill(*openStart(folder / "a.sqlite", registry), start);
    for (const world::ChunkPos pos : {world::ChunkPos{1, 0}, {5, 0}}) {
        runSql(folder / "a.sqlite",
               "UPDATE chunks SET data = x'0102' WHERE key = " + std::to_string(keyOf(pos)));
        start.ledger.found(pos, 0);
        ++start.damaged;
    }
    start.files = filesIn(folder);
    return start;
}

Start saveAfterKill() {
    Start start;
    const base::TempFolder folder;
    const world::BlockRegistry registry = testRegistry();
    const auto store = openStart(folder / "a.sqlite", registry);
    fill(*store, start);
    start.files = filesIn(folder);
    return start;
}

}  // namespace terrane::store
