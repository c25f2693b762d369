// Saves chunks endlessly and reports durable saves, to be killed by tools/kill_test.py.
//
// save_loop FILE FIRST: saves from number FIRST on, prints the number of each last durable save on a line.
//
// save_loop FILE verify LAST: exit code 0 if every chunk has its edit of saves 1 … LAST, or a later one, and
// every tile is derived from the chunks, byte for byte.
//
// Save n edits the chunk n mod 100: sets it to numberedChunk(n) with n as block entity data, which identifies
// the save. Every third round through the chunks makes them count as empty, so that tiles
// (tests/store/tile_sums.h) disappear, too.
#include <cstdio>
#include <cstring>
#include <string>

#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/save_file.h"
#include "terrane/store/sqlite/chunk_reader.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"
#include "tests/store/tile_sums.h"

namespace {

using namespace terrane;

constexpr int kChunks = 100;
constexpr world::BlockIndex kMark = 12345;

world::ChunkPos posOf(int number) {
    return {number % kChunks % 10, number % kChunks / 10};
}

world::ChunkPtr edited(int number) {
    auto chunk = std::make_shared<world::Chunk>(*store::numberedChunk(number));
    if (number / kChunks % 3 == 2) chunk->setBlock(0, world::kAir);
    const auto bytes = std::as_bytes(std::span(&number, 1));
    chunk->setBlockEntityData(kMark, world::BlockEntityData(bytes.begin(), bytes.end()));
    return chunk;
}

// The number in a chunk; 0 if it has none.
int numberIn(const world::Chunk& chunk) {
    int number = 0;
    const world::BlockEntityData* mark = chunk.blockEntityData(kMark);
    if (mark && mark->size() == sizeof number) std::memcpy(&number, mark->data(), sizeof number);
    return chunk == *edited(number) ? number : 0;
}

[[noreturn]] void saveForEver(store::ChunkStore& store, int first) {
    store::SaveNumber told = 0;
    for (int number = first;; ++number) {
        const store::SaveNumber save = store.save(posOf(number), edited(number), store::Provenance::Edited);
        if (number % 64 == 0 && !store.flush()) std::exit(3);
        const store::SaveNumber durable = store.status().durable;
        if (durable == told) continue;
        told = durable;
        std::printf("%d\n", number - static_cast<int>(save - durable));
        std::fflush(stdout);
    }
}

int verify(store::ChunkStore& store, int last) {
    for (int number = std::max(1, last - kChunks + 1); number <= last; ++number) {
        const store::LoadedChunk loaded = store.load(posOf(number));
        const int found = loaded.chunk ? numberIn(*loaded.chunk) : 0;
        if (found >= number && found % kChunks == number % kChunks) continue;
        std::fprintf(stderr, "chunk %d holds save %d, expected %d or later\n", number % kChunks, found,
                     number);
        return 1;
    }
    return 0;
}

// Compares the rows of levels above 0 with tiles derived from the rows of level 0. Reads the file directly,
// without an open store.
base::Result<void> verifyTiles(const char* path, const world::BlockRegistry& registry) {
    auto file = store::openToRead(path, registry);
    if (!file) return tl::unexpected(file.error());
    auto select = file->database.prepare("SELECT key, data FROM chunks ORDER BY key");
    if (!select) return tl::unexpected(select.error());
    std::vector<store::ChunkRow> chunks;
    std::map<world::ChunkPos, store::Bytes> tiles;
    while (true) {
        const auto row = select->step();
        if (!row) return tl::unexpected(row.error());
        if (!*row) break;
        const world::ChunkPos pos = store::posOf(select->number(0));
        const store::ByteView data = select->blob(1);
        if (pos.level > 0) {
            tiles.emplace(pos, store::Bytes(data.begin(), data.end()));
            continue;
        }
        auto chunk =
            store::decodeChunk(data, file->ids, file->identity.heights, store::checksumSeed(pos, true));
        if (!chunk) return tl::unexpected(chunk.error());
        chunks.push_back({pos, std::make_shared<world::Chunk>(std::move(*chunk))});
    }
    std::map<world::ChunkPos, store::Bytes> expected;
    for (const auto& [pos, tile] : store::tilesOf(chunks))
        expected.emplace(pos, *store::encodeChunk(*tile, file->ids, store::checksumSeed(pos, true)));
    std::printf("%zu chunks, %zu tiles\n", chunks.size(), tiles.size());
    if (tiles == expected) return {};
    return base::fail("{} chunks have {} tiles, expected {} or others", chunks.size(), tiles.size(),
                      expected.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    const bool isVerifying = std::strcmp(argv[2], "verify") == 0;
    const auto registry = store::testRegistry();
    // Verifies before a store opens the file.
    const auto verified = isVerifying ? verifyTiles(argv[1], registry) : base::Result<void>();
    if (!verified) {
        std::fprintf(stderr, "%s\n", verified.error().message.c_str());
        return 1;
    }
    const store::SaveAccess access{.create = isVerifying ? std::nullopt : std::optional(store::kIdentity),
                                   .decide = {}};
    auto store = store::SqliteStore::open(argv[1], registry, access,
                                          {.delay = std::chrono::milliseconds(5), .chunks = 50});
    if (!store) {
        std::fprintf(stderr, "%s\n", store.error().message.c_str());
        return 2;
    }
    if (isVerifying) return verify(**store, std::atoi(argv[3]));
    (*store)->setDerivedRows({store::deriveSums, {}});
    if (!store::ensureDerivedRows(**store, "sums")) return 3;
    saveForEver(**store, std::atoi(argv[2]));
}
