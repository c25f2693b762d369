#include "terrane/net/server/server_view.h"

#include <algorithm>
#include <utility>

#include "terrane/net/server/server_clients.h"
#include "terrane/net/wire/client_message.h"

namespace terrane::net {
namespace {

using world::ChunkPos;

// No more differences are sent to a client with this many unsent bytes.
constexpr std::size_t kUnsentBytes = 64 << 10;
// Maximum number of differences being computed for a client.
constexpr std::size_t kLooksAhead = 16;
// A tile with ongoing edits changes each time that the world is saved; it is sent again at this interval.
constexpr std::uint64_t kTicksPerTileChange = 200;

ChunkPos above(ChunkPos chunk, int level) {
    return {chunk.x >> level, chunk.y >> level, static_cast<std::uint8_t>(level)};
}

// Squared distance from the center of the view, in chunks of level 0.
double orderOf(const View& view, ChunkPos pos) {
    const double width = 1 << pos.level;
    const double x = (pos.x + 0.5) * width - view.center.x, y = (pos.y + 0.5) * width - view.center.y;
    return x * x + y * y;
}

// The blocks that the client's view needs.
ChunkDifference neededBlocks(const View& view, std::span<const ChangedBlock> blocks) {
    ChunkDifference needed;
    for (const ChangedBlock& block : blocks)
        if (block.index >> 8 >= view.lowest) needed.push_back(block);
    return needed;
}

void sendDifference(ServerClient& client, ChunkPos pos, const ChunkDifference& difference) {
    bool isFirst = true;
    for (const std::span<const ChangedBlock> part : partsOf(difference)) {
        send(client, ChunkEdits{pos, isFirst, ChunkDifference(part.begin(), part.end())});
        isFirst = false;
    }
}

// Sets the client's view and collects the edited chunks and tiles to send.
void setClientView(ServerClient& client, const EditedChunks& edited, const View& view) {
    // What was withheld and is needed now is told again, from the beginning.
    if (client.view && view.lowest < client.view->lowest)
        for (const ChunkPos pos : std::exchange(client.withheld, {})) client.told.erase(pos);
    client.view = view;
    const auto isOut = [&](ChunkPos pos) { return !isInView(*client.view, pos, 1); };
    std::erase_if(client.told, isOut);
    std::erase_if(client.withheld, isOut);
    client.toTell.clear();
    for (int level = 0; level <= topLevelOf(*client.view); ++level) {
        const int radius = level == 0 ? client.view->viewDistance + 1 : kFarthestTile;
        for (const ChunkPos pos : edited.within(above(view.center, level), radius))
            if (!client.told.contains(pos) && isInView(*client.view, pos)) client.toTell.push_back(pos);
    }
    std::ranges::sort(client.toTell, [&](ChunkPos a, ChunkPos b) {
        return std::pair(orderOf(view, a), a) > std::pair(orderOf(view, b), b);
    });
    client.owesViewComplete = true;
}

// Sends the nearest available differences until the client's buffer is full.
void sendView(ServerClient& client, EditedChunks& edited) {
    std::size_t pending = 0;
    for (std::size_t k = client.toTell.size(); k-- > 0 && pending < kLooksAhead;) {
        if (client.outgoing.size() + client.unsent >= kUnsentBytes) return;
        const ChunkPos pos = client.toTell[k];
        const ChunkDifference* difference = edited.maybeDifference(pos);
        if (!difference) {
            ++pending;
            continue;
        }
        const ChunkDifference needed = neededBlocks(*client.view, *difference);
        if (!needed.empty() || difference->empty()) sendDifference(client, pos, needed);
        client.told.insert(pos);
        if (needed.size() < difference->size()) client.withheld.insert(pos);
        client.toTell.erase(client.toTell.begin() + static_cast<std::ptrdiff_t>(k));
    }
    if (!client.toTell.empty() || !client.owesViewComplete) return;
    client.owesViewComplete = false;
    send(client, ViewComplete{client.view->center});
}

// Sends changed tiles to all clients that see them.
void tellChangedTiles(ServerClients& clients, ServerEdits& edits) {
    if (clients.tick % kTicksPerTileChange != 0) return;
    for (const ChunkPos tile : edits.tilesToTell) {
        edits.chunks.onTileChanged(tile);
        forEachPlaying(clients, [&](ServerClient& client) {
            client.told.erase(tile);
            client.withheld.erase(tile);
            if (!client.view || !isInView(*client.view, tile)) return;
            if (tile.level <= topLevelOf(*client.view) && std::ranges::count(client.toTell, tile) == 0)
                client.toTell.insert(client.toTell.begin(), tile);
        });
    }
    edits.tilesToTell.clear();
}

std::vector<ChunkPos> takeTiles(WrittenTiles& written) {
    const std::lock_guard lock(written.mutex);
    return std::exchange(written.tiles, {});
}

ChunkDifference valuesNow(const world::World& world, ChunkPos pos, std::vector<world::BlockIndex>& indices) {
    std::ranges::sort(indices);
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    ChunkDifference blocks;
    for (const world::BlockIndex index : indices)
        blocks.push_back({index, world::blockValue(world, world::blockPos(pos, index))});
    return blocks;
}

}  // namespace

void onTilesChanged(ServerEdits& edits, std::span<const ChunkPos> tiles) {
    edits.tilesToTell.insert(tiles.begin(), tiles.end());
    if (edits.onChanged && !tiles.empty()) edits.onChanged(tiles);
}

void sendBlocks(ServerClients& clients, ServerEdits& edits, ChunkPos pos, const ChunkDifference& blocks) {
    const bool isNew = edits.chunks.add(pos);
    edits.chunks.onChanged(pos, blocks);
    if (edits.onChanged) edits.onChanged(std::span(&pos, 1));
    const auto encoded = [&](const ChunkDifference& part) {
        std::vector<Bytes> messages;
        for (const std::span<const ChangedBlock> some : partsOf(part))
            messages.push_back(
                encode(ServerMessage(BlocksChanged{pos, ChunkDifference(some.begin(), some.end())})));
        return messages;
    };
    const std::vector<Bytes> messages = encoded(blocks);
    forEachPlaying(clients, [&](ServerClient& client) {
        // A client that lacks the chunk will get all of it soon. A client that has it gets every change, even
        // after the chunk left its view.
        if (isNew && client.view && isInView(*client.view, pos)) client.told.insert(pos);
        if (!client.told.contains(pos)) return;
        const ChunkDifference needed = client.view ? neededBlocks(*client.view, blocks) : blocks;
        if (needed.size() < blocks.size()) client.withheld.insert(pos);
        if (needed.empty()) return;
        for (const Bytes& message : needed.size() < blocks.size() ? encoded(needed) : messages)
            sendEncoded(client, message);
    });
}

void sendChangedBlocks(ServerClients& clients, ServerEdits& edits, const world::World& world,
                       ChangedIndices changed) {
    for (auto& [chunk, indices] : changed)
        sendBlocks(clients, edits, chunk, valuesNow(world, chunk, indices));
}

void sendViews(ServerClients& clients, ServerEdits& edits) {
    edits.chunks.update();
    const std::vector<ChunkPos> tiles = takeTiles(*edits.writtenTiles);
    onTilesChanged(edits, tiles);
    if (clients.shared && !tiles.empty()) clients.shared->publishTiles(tiles);
    tellChangedTiles(clients, edits);
    forEachPlaying(clients, [&](ServerClient& client) {
        if (const auto asked = std::exchange(client.askedView, std::nullopt))
            setClientView(client, edits.chunks, servedView(*asked, clients.settings.maxViewDistance));
        if (client.view) sendView(client, edits.chunks);
    });
}

}  // namespace terrane::net
