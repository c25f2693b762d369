#include "tests/fuzz/fuzz_saves.h"

#include <system_error>

#include "terrane/base/log.h"
#include "terrane/store/saves/open_world.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/sqlite/sqlite.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"

namespace terrane::fuzz {
namespace {

using store::Provenance;

store::WorldIdentity identityOf(world::Heights heights) {
    return {.seed = 7, .generator = "flat", .generatorVersion = 3, .heights = heights};
}
// Only flush and closing write.
constexpr store::SaveLimits kNever{.delay = std::chrono::hours(1), .chunks = 1000000};

const world::BlockRegistry& registry() {
    static const world::BlockRegistry blocks = *world::BlockRegistry::parse(
        "[[block]]\nname = \"stone\"\nshape = \"cube\"\ntexture = \"stone\"\n"
        "[[block]]\nname = \"dirt\"\nshape = \"cube\"\ntexture = \"dirt\"\n",
        "fuzz");
    return blocks;
}

world::ChunkPtr chunkOf(int number, world::Heights heights) {
    auto chunk = std::make_shared<world::Chunk>(heights);
    chunk->setSection(heights.firstSection(), world::Section(1));
    const int z = heights.clamp(20);
    chunk->setBlock(world::blockIndex(number % 16, 1, z), 2);
    chunk->setBlockState(world::blockIndex(1, 1, z), static_cast<std::uint16_t>(number));
    return chunk;
}

// SQLite accepts a page size only before the first table is created.
void makeSmallPages(const std::filesystem::path& path) {
    auto database = store::Database::open(path, store::OpenMode::Create);
    require(database && database->execute("PRAGMA page_size = 512; CREATE TABLE t (n); DROP TABLE t"));
}

SaveBytes makeSmallSave(world::Heights heights) {
    base::setLogLevel(base::LogLevel::Silent);
    emptyFolder();
    makeSmallPages(savePath());
    const store::SaveAccess access{.create = identityOf(heights), .decide = {}};
    {
        const auto made = store::SqliteStore::open(savePath(), registry(), access, kNever);
        require(made.has_value());
        for (int k = 0; k < 3; ++k)
            (*made)->save(savedPositions()[k], chunkOf(k, heights),
                          k == 0 ? Provenance::Generated : Provenance::Edited);
        (*made)->setMetadata("player", "1 2 3");
    }
    const auto open = store::SqliteStore::open(savePath(), registry(), access, kNever);
    require(open.has_value());
    for (int k = 3; k < 5; ++k) {
        (*open)->save(savedPositions()[k], chunkOf(k, heights), Provenance::Edited);
        require((*open)->flush().has_value());
    }
    return {readWhole(savePath()), readWhole(savePath().string() + "-wal")};
}

template <class T>
bool isGood(const base::Result<T>& result) {
    if (!result) requireReason(result.error());
    return result.has_value();
}

store::WorldRequest requestFor(store::WorldAccess access) {
    return {.access = access,
            .create = std::nullopt,
            .world = {},
            .versionOf = [](std::string_view) { return identityOf({}).generatorVersion; },
            .limits = kNever};
}

auto openSave(store::WorldAccess access) {
    return store::openWorld({store::WorldLocation::Kind::File, savePath().string()}, registry(),
                            requestFor(access));
}

void readAll(store::ReadableStore& world) {
    const auto loaded = world.loadMany(savedPositions());
    require(loaded.size() == savedPositions().size());
    for (const store::LoadedChunk& chunk : loaded)
        require((chunk.chunk != nullptr) == (chunk.state == store::LoadedChunk::State::Present));
    isGood(world.editedChunks());
    world.metadata("player");
}

void readSave() {
    const std::string file = readWhole(savePath()), log = readWhole(savePath().string() + "-wal");
    const auto report = store::checkSave(savePath(), registry());
    if (isGood(report)) {
        for (const std::string& problem : report->fileProblems) require(!problem.empty());
        for (const store::DamagedChunk& chunk : report->damaged) require(!chunk.problem.empty());
    }
    if (const auto world = openSave(store::WorldAccess::ReadOnly); isGood(world)) readAll(**world);
    require(readWhole(savePath()) == file && readWhole(savePath().string() + "-wal") == log);
}

bool has(const base::Result<std::unique_ptr<store::SqliteReader>>& reader, world::ChunkPos pos, int number) {
    const store::LoadedChunk loaded = (*reader)->load(pos);
    return loaded.chunk && *loaded.chunk == *chunkOf(number, (*reader)->identity().heights);
}

void playInSave() {
    constexpr world::ChunkPos kNew{40, -40};
    const world::ChunkPos old = savedPositions()[0];
    bool isSaved = false;
    {
        const auto world = openSave(store::WorldAccess::ReadWrite);
        if (!isGood(world)) return;
        readAll(**world);
        const world::Heights heights = (*world)->identity().heights;
        (*world)->save(kNew, chunkOf(40, heights), Provenance::Edited);
        (*world)->save(old, chunkOf(41, heights), Provenance::Edited);
        (*world)->setMetadata("player", "4 5 6");
        isSaved = isGood((*world)->flush());
        readAll(**world);
    }
    if (!isSaved) return;
    const auto again = store::SqliteReader::open(savePath(), registry());
    require(isGood(again) && has(again, kNew, 40) && has(again, old, 41));
    require((*again)->metadata("player") == "4 5 6");
}

}  // namespace

const std::vector<world::ChunkPos>& savedPositions() {
    static const std::vector<world::ChunkPos> positions = {{0, 0}, {1, 0}, {-1, 5}, {2, -3}, {0, -2, 1}};
    return positions;
}

const SaveBytes& smallSave() {
    static const SaveBytes save = makeSmallSave({});
    return save;
}

const SaveBytes& tallSave() {
    static const SaveBytes save = makeSmallSave({-64, 320});
    return save;
}

std::filesystem::path savePath() {
    return fuzzFolder() / "a.sqlite";
}

void writeSave(const SaveBytes& save) {
    emptyFolder();
    writeWhole(savePath(), save.file);
    if (!save.log.empty()) writeWhole(savePath().string() + "-wal", save.log);
}

void useSave() {
    readSave();
    playInSave();
}

}  // namespace terrane::fuzz
