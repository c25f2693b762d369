#include "terrane/store/chunk_reader.h"

#include <utility>

#include "terrane/store/chunk_codec.h"
#include "terrane/store/chunk_key.h"

namespace terrane::store {

LoadedChunk decodeRow(const StoredRow& row, const BlockIdMap& ids) {
    if (row && !*row) return {};
    base::Result<world::Chunk> chunk = row ? decodeChunk((*row)->data, ids) : tl::unexpected(row.error());
    if (chunk) {
        return {LoadedChunk::State::Present,
                std::make_shared<world::Chunk>(std::move(*chunk)),
                (*row)->provenance,
                {}};
    }
    LoadedChunk damaged;
    damaged.state = LoadedChunk::State::Damaged;
    damaged.problem = chunk.error().message;
    return damaged;
}

StoredRow readRow(Statement& select, world::ChunkPos pos) {
    select.bind(1, keyOf(pos));
    const auto row = select.step();
    std::optional<StoredChunk> chunk;
    if (row && *row) {
        const ByteView data = select.blob(0);
        const Provenance provenance = select.number(1) == 0 ? Provenance::Generated : Provenance::Edited;
        chunk = StoredChunk{Bytes(data.begin(), data.end()), provenance};
    }
    select.reset();
    if (!row) return tl::unexpected(row.error());
    return chunk;
}

base::Result<std::vector<world::ChunkPos>> readEditedChunks(Database& database) {
    auto select = database.prepare(
        fmt::format("SELECT key FROM chunks WHERE origin = {} AND key >= 0 AND key < {} ORDER BY key",
                    static_cast<int>(Provenance::Edited), kFirstTileKey));
    if (!select) return tl::unexpected(select.error());
    std::vector<world::ChunkPos> edited;
    while (true) {
        const auto row = select->step();
        if (!row) return tl::unexpected(row.error());
        if (!*row) return edited;
        edited.push_back(posOf(select->number(0)));
    }
}

base::Result<std::unique_ptr<ChunkReader::Connection>> ChunkReader::open() const {
    auto database = Database::open(path_, mode_);
    if (!database) return tl::unexpected(database.error());
    auto select = database->prepare("SELECT data, origin FROM chunks WHERE key = ?1");
    if (!select) return tl::unexpected(select.error());
    auto count = database->prepare("SELECT count(*) FROM chunks WHERE key = ?1");
    if (!count) return tl::unexpected(count.error());
    auto begin = database->prepare("BEGIN");
    if (!begin) return tl::unexpected(begin.error());
    auto end = database->prepare("COMMIT");
    if (!end) return tl::unexpected(end.error());
    return std::make_unique<Connection>(Connection{std::move(*database), std::move(*select),
                                                   std::move(*count), std::move(*begin), std::move(*end)});
}

base::Result<std::unique_ptr<ChunkReader::Connection>> ChunkReader::take() {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            auto connection = std::move(idle_.back());
            idle_.pop_back();
            return connection;
        }
    }
    return open();
}

void ChunkReader::giveBack(std::unique_ptr<Connection> connection) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(connection));
}

StoredRow ChunkReader::read(world::ChunkPos pos) {
    auto connection = take();
    if (!connection) return tl::unexpected(connection.error());
    StoredRow row = readRow((*connection)->select, pos);
    giveBack(std::move(*connection));
    return row;
}

std::vector<StoredRow> ChunkReader::readMany(std::span<const world::ChunkPos> positions) {
    auto connection = take();
    std::vector<StoredRow> rows;
    rows.reserve(positions.size());
    if (!connection) {
        // Not as copies of one: copying a result ends the program where there is no memory for its message.
        while (rows.size() < positions.size()) rows.push_back(tl::unexpected(connection.error()));
        return rows;
    }
    // A transaction that cannot begin makes it slower, not wrong.
    const bool hasBegun = (*connection)->begin.run().has_value();
    for (const world::ChunkPos pos : positions) rows.push_back(readRow((*connection)->select, pos));
    const bool hasEnded = !hasBegun || (*connection)->end.run();
    // One that cannot end goes with its connection.
    if (hasEnded) giveBack(std::move(*connection));
    return rows;
}

base::Result<bool> ChunkReader::contains(world::ChunkPos pos) {
    auto connection = take();
    if (!connection) return tl::unexpected(connection.error());
    Statement& count = (*connection)->count;
    count.bind(1, keyOf(pos));
    const auto row = count.step();
    const bool found = row && *row && count.number(0) > 0;
    count.reset();
    giveBack(std::move(*connection));
    if (!row) return tl::unexpected(row.error());
    return found;
}

base::Result<std::vector<world::ChunkPos>> ChunkReader::editedChunks() {
    auto connection = take();
    if (!connection) return tl::unexpected(connection.error());
    auto edited = readEditedChunks((*connection)->database);
    giveBack(std::move(*connection));
    return edited;
}

}  // namespace terrane::store
