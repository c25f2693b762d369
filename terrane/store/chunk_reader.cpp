#include "terrane/store/chunk_reader.h"

#include <utility>

#include "terrane/store/schema.h"

namespace terrane::store {

base::Result<std::unique_ptr<ChunkReader::Connection>> ChunkReader::take() {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            auto connection = std::move(idle_.back());
            idle_.pop_back();
            return connection;
        }
    }
    auto database = Database::open(path_, mode_);
    if (!database) return tl::unexpected(database.error());
    auto select = database->prepare("SELECT data, origin FROM chunks WHERE key = ?1");
    if (!select) return tl::unexpected(select.error());
    auto count = database->prepare("SELECT count(*) FROM chunks WHERE key = ?1");
    if (!count) return tl::unexpected(count.error());
    return std::make_unique<Connection>(
        Connection{std::move(*database), std::move(*select), std::move(*count)});
}

void ChunkReader::giveBack(std::unique_ptr<Connection> connection) {
    connection->select.reset();
    connection->count.reset();
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(connection));
}

base::Result<std::optional<StoredChunk>> ChunkReader::read(world::ChunkPos pos) {
    auto connection = take();
    if (!connection) return tl::unexpected(connection.error());
    Statement& select = (*connection)->select;
    select.bind(1, keyOf(pos));
    const auto row = select.step();
    std::optional<StoredChunk> chunk;
    if (row && *row) {
        const ByteView data = select.blob(0);
        const Origin origin = select.number(1) == 0 ? Origin::Generated : Origin::Edited;
        chunk = StoredChunk{Bytes(data.begin(), data.end()), origin};
    }
    giveBack(std::move(*connection));
    if (!row) return tl::unexpected(row.error());
    return chunk;
}

base::Result<bool> ChunkReader::contains(world::ChunkPos pos) {
    auto connection = take();
    if (!connection) return tl::unexpected(connection.error());
    Statement& count = (*connection)->count;
    count.bind(1, keyOf(pos));
    const auto row = count.step();
    const bool found = row && *row && count.number(0) > 0;
    giveBack(std::move(*connection));
    if (!row) return tl::unexpected(row.error());
    return found;
}

}  // namespace terrane::store
