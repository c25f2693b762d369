// Saves chunks without end and reports what is durable, to be killed by tools/kill_test.py.
//
//   save_loop FILE FIRST         from save FIRST on, prints the number of each last durable save on a line
//   save_loop FILE verify LAST   exit code 0 where every chunk holds save 1 … LAST's edit of it, or a later
//   one
//
// Save n edits the chunk n mod 100: sets it to numberedChunk(n) with n as block entity data, so that what is
// found tells which save it is from.
#include <cstdio>
#include <cstring>
#include <string>

#include "terrane/store/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace {

using namespace terrane;

constexpr int kChunks = 100;
constexpr world::BlockIndex kMark = 12345;

world::ChunkPos posOf(int number) {
    return {number % kChunks % 10, number % kChunks / 10};
}

world::ChunkPtr edited(int number) {
    auto chunk = std::make_shared<world::Chunk>(*store::numberedChunk(number));
    const auto bytes = std::as_bytes(std::span(&number, 1));
    chunk->setBlockEntityData(kMark, world::BlockEntityData(bytes.begin(), bytes.end()));
    return chunk;
}

// 0 where there is none.
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

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    const bool isVerifying = std::strcmp(argv[2], "verify") == 0;
    const auto registry = store::testRegistry();
    const store::SaveAccess access{.create = isVerifying ? std::nullopt : std::optional(store::kIdentity),
                                   .decide = {}};
    auto store = store::SqliteStore::open(argv[1], registry, access,
                                          {.delay = std::chrono::milliseconds(5), .chunks = 50});
    if (!store) {
        std::fprintf(stderr, "%s\n", store.error().message.c_str());
        return 2;
    }
    if (isVerifying) return verify(**store, std::atoi(argv[3]));
    saveForEver(**store, std::atoi(argv[2]));
}
