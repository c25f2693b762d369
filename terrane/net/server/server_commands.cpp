#include "terrane/net/server/server_commands.h"

#include <algorithm>

#include "terrane/base/match.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/store/chunks/structure_file.h"
#include "terrane/world/blocks/inventory.h"
#include "terrane/world/blocks/sign.h"
#include "terrane/world/items/item_table.h"

namespace terrane::net {
namespace {

constexpr std::size_t kMaxWaitingCommands = 512;
// Block entity data in waiting commands; an edit has up to 32 KiB.
constexpr std::size_t kMaxWaitingBytes = 1 << 20;
// A command whose chunks are not loaded after this time runs anyway; the session refuses it.
constexpr std::uint64_t kMaxWaitTicks = 60;
// Chunks of one command; a line of 65,536 blocks would touch 12,000.
constexpr int kMaxChunks = 1024;
// Neighbors of a changed block may change with it, such as attached blocks and the arms of fences. All are
// nearer than this.
constexpr std::int32_t kBlocksBeside = 8;
// Decisions that are not durable yet; beyond this no more commands run.
constexpr std::size_t kMaxUntold = 1024;
// A structure is decoded before its size is known: it counts as this many edits.
constexpr double kEditsOfPlace = 30;
// Block entity data in one chunk, which is saved and sent in one piece.
constexpr std::size_t kMaxChunkData = 1 << 20;
// Of a placed structure, unpacked in the tick: 500,000 cells of 2 bytes, a palette and data.
constexpr std::size_t kMaxPlacedBytes = 2 << 20;
// Block entity data of a placed structure, which the undo steps keep.
constexpr std::size_t kMaxPlacedData = 64 << 10;
// After an edit, the chunks around the player are loaded for this time, since more edits are likely.
constexpr std::chrono::seconds kLoadsAround{20};
constexpr std::chrono::milliseconds kLoadAroundEvery{1000};

std::size_t dataBytes(const world::Structure& structure) {
    std::size_t bytes = 0;
    for (const world::StructureData& data : structure.data) bytes += data.data->size();
    return bytes;
}

std::size_t dataBytes(const WaitingCommand& waiting) {
    const auto* edit = std::get_if<Edit>(&waiting.command);
    const auto* data = edit ? std::get_if<world::SetEntityData>(&edit->change) : nullptr;
    return data ? data->data.size() : 0;
}

std::int32_t chunkAt(std::int32_t block, std::int32_t away) {
    return static_cast<std::int32_t>((std::int64_t{block} + away) >> 4);
}

// Requests the chunks that the box and its neighbor blocks touch. Returns whether all are loaded, or there
// are too many to wait for.
bool areLoaded(stream::ChunkPipeline& pipeline, const world::BlockBox& box) {
    const std::int32_t lowX = chunkAt(box.low.x, -kBlocksBeside), highX = chunkAt(box.high.x, kBlocksBeside);
    const std::int32_t lowY = chunkAt(box.low.y, -kBlocksBeside), highY = chunkAt(box.high.y, kBlocksBeside);
    // Each is at most 2^28 chunks.
    const std::int64_t width = highX - lowX + 1, depth = highY - lowY + 1;
    if (width * depth > kMaxChunks) return true;
    bool all = true;
    for (std::int32_t y = lowY; y <= highY; ++y)
        for (std::int32_t x = lowX; x <= highX; ++x) {
            const world::ChunkPos pos{x, y};
            if (world::isInWorld(pos)) all &= pipeline.maybeLoadChunkAt(pos) != nullptr;
        }
    return all;
}

double blockCount(const world::BlockBox& box) {
    const auto side = [](std::int32_t low, std::int32_t high) {
        return static_cast<double>(std::max<std::int64_t>(std::int64_t{high} - low + 1, 0));
    };
    return side(box.low.x, box.high.x) * side(box.low.y, box.high.y) * side(box.low.z, box.high.z);
}

bool isKnown(const game::Session& session, world::BlockId id) {
    return id < session.blocks().types().size();
}

// Whether all items are known to the server, or were there before: other names are only a load.
bool hasKnownItems(const world::BlockRegistry& blocks, const world::Inventory& items,
                   const world::Inventory& former) {
    return std::ranges::all_of(items, [&](const world::ItemStack& stack) {
        return stack.count == 0 || blocks.items().find(stack.item) ||
               std::ranges::count(former, stack.item, &world::ItemStack::item) > 0;
    });
}

// Whether `data` is valid block entity data for the type: other data is only a load on disk and network.
// `former`: the data that it replaces, or null.
bool keepsData(const world::BlockRegistry& blocks, const world::BlockType& type,
               const world::BlockEntityData& data, const world::BlockEntityData* former = nullptr) {
    if (world::isSign(type)) return world::decodeSign(data).has_value();
    if (type.slots == 0 || data.size() > kMaxBlockData) return false;
    const auto items = world::decodeSlots(data);
    const auto before = former ? world::decodeSlots(*former) : world::Inventory();
    return items && hasKnownItems(blocks, *items, before.value_or(world::Inventory()));
}

// Removes invalid block entity data.
void dropOtherData(world::Structure& structure, const world::BlockRegistry& blocks) {
    const std::vector<world::BlockValue> values = world::paletteValues(structure, blocks);
    std::erase_if(structure.data, [&](const world::StructureData& data) {
        return !keepsData(blocks, blocks.type(values[structure.cells[data.cell]].id), *data.data);
    });
}

// Whether each loaded chunk that the box touches has room for `bytes` more of block entity data.
bool hasRoom(const world::World& world, const world::BlockBox& box, std::size_t bytes) {
    const world::ChunkPos low = world::chunkOf(box.low), high = world::chunkOf(box.high);
    for (std::int32_t y = low.y; y <= high.y; ++y)
        for (std::int32_t x = low.x; x <= high.x; ++x) {
            const world::ChunkPtr chunk = world.maybeChunkAt({x, y});
            if (chunk && chunk->blockEntityDataBytes() + bytes > kMaxChunkData) return false;
        }
    return true;
}

// Rejects unknown block types, which cannot be saved, and invalid or too much data.
bool isSensible(const game::Session& session, const Edit& edit) {
    if (const auto* block = std::get_if<world::SetBlock>(&edit.change)) return isKnown(session, block->id);
    const auto* data = std::get_if<world::SetEntityData>(&edit.change);
    if (!data) return true;
    if (!session.world().maybeChunkAt(world::chunkOf(edit.pos))) return true;
    const world::BlockType& type = session.blocks().type(session.world().block(edit.pos));
    const world::BlockEntityData* former = session.world().blockEntityData(edit.pos);
    const std::size_t freed = former ? std::min(former->size(), data->data.size()) : 0;
    return data->data.empty() || (keepsData(session.blocks(), type, data->data, former) &&
                                  hasRoom(session.world(), {edit.pos, edit.pos}, data->data.size() - freed));
}
bool isSensible(const game::Session& session, const Build& build) {
    if (const auto* fill = std::get_if<game::FillBox>(&build.change)) return isKnown(session, fill->id);
    const world::Structure& structure = *std::get<game::PlaceStructure>(build.change).structure;
    return structure.data.empty() ||
           hasRoom(session.world(), game::boxOf(build.change), dataBytes(structure));
}

Done run(game::Session& session, const ServerClient& client, const Edit& edit) {
    if (!isSensible(session, edit))
        return {edit.number, static_cast<std::uint8_t>(game::EditResult::BadData), 0, 0};
    const auto result = session.edit({client.player, edit.pos, edit.change, edit.expected});
    return {edit.number, static_cast<std::uint8_t>(result), 0, 0};
}

Done run(game::Session& session, const ServerClients& clients, ServerClient& client, const Build& build) {
    const double blocks = blockCount(game::boxOf(build.change));
    game::BuildOutcome outcome{game::BuildOutcome::Result::TooLarge, 0, 0};
    if (!isSensible(session, build))
        outcome.result = game::BuildOutcome::Result::Empty;
    else if (blocks <= static_cast<double>(clients.settings.maxFillBlocks))
        outcome = client.buckets.blocks.take(blocks, clients.now)
                      ? session.build({client.player, build.change})
                      : game::BuildOutcome{game::BuildOutcome::Result::TooSoon, 0, 0};
    return {build.number, static_cast<std::uint8_t>(outcome.result),
            static_cast<std::uint32_t>(outcome.changed), static_cast<std::uint32_t>(outcome.skipped)};
}

game::HistoryWay wayOf(const TakeBack& takeBack) {
    return takeBack.isRedo ? game::HistoryWay::Redo : game::HistoryWay::Undo;
}

Done run(game::Session& session, ServerClient& client, const TakeBack& takeBack) {
    const game::UndoResult taken = session.undoOrRedo(client.player, wayOf(takeBack));
    client.buckets.blocks.spend(static_cast<double>(taken.blocks + taken.skipped));
    return {takeBack.number, static_cast<std::uint8_t>(taken.outcome),
            static_cast<std::uint32_t>(taken.blocks), static_cast<std::uint32_t>(taken.skipped)};
}

// The block that an action with items needs.
std::optional<world::BlockPos> blockOf(const game::ItemAction& action) {
    if (const auto* move = std::get_if<game::MoveStack>(&action))
        return move->from.block ? move->from.block : move->to.block;
    const auto* craft = std::get_if<game::CraftItems>(&action);
    return craft ? craft->workbench : std::nullopt;
}

Done run(game::Session& session, const ServerClient& client, const ItemCommand& command) {
    game::EditResult result = game::EditResult::BadData;
    const auto block = blockOf(command.action);
    // An item's name and count take at most 260 bytes in the data of a chest.
    constexpr std::size_t kMostAdded = 260;
    if (!block || hasRoom(session.world(), {*block, *block}, kMostAdded))
        result = session.act(client.player, command.action);
    return {command.number, static_cast<std::uint8_t>(result), 0, 0};
}

// Requests the chunks of a command. Returns whether all are loaded, or the session will refuse it anyway.
bool isReady(game::Session& session, const ServerClient& client, const WaitingCommand& waiting,
             std::size_t maxFillBlocks) {
    const auto isBoxReady = [&](const world::BlockBox& box) {
        const bool isNear = game::distanceTo(box, poseOf(client.pose).position) <= game::kBuildReach;
        return !isNear || areLoaded(session.pipeline(), box);
    };
    return std::visit(
        base::Match{
            [&](const Edit& edit) {
                return isBoxReady({edit.pos, edit.pos});
            },
            [&](const Build& build) {
                const world::BlockBox box = game::boxOf(build.change);
                const double blocks = blockCount(box);
                return blocks == 0 || blocks > static_cast<double>(maxFillBlocks) || isBoxReady(box);
            },
            [&](const TakeBack& takeBack) {
                bool all = true;
                for (const world::ChunkPos pos : session.chunksOfNextStep(client.player, wayOf(takeBack)))
                    all &= session.pipeline().maybeLoadChunkAt(pos) != nullptr;
                return all;
            },
            [&](const ItemCommand& command) {
                const auto block = blockOf(command.action);
                return !block || isBoxReady({*block, *block});
            },
        },
        waiting.command);
}

// Result if another server was first: Conflict for an edit, NotLoaded for others, which may be tried again.
std::uint8_t refusedResult(const WaitingCommand& command) {
    if (std::holds_alternative<Edit>(command.command) || std::holds_alternative<ItemCommand>(command.command))
        return static_cast<std::uint8_t>(game::EditResult::Conflict);
    if (std::holds_alternative<Build>(command.command))
        return static_cast<std::uint8_t>(game::BuildOutcome::Result::NotLoaded);
    return static_cast<std::uint8_t>(game::UndoResult::Outcome::NotLoaded);
}

Done decide(game::Session& session, const ServerClients& clients, ServerClient& client,
            const WaitingCommand& next) {
    return std::visit(base::Match{
                          [&](const Build& build) { return run(session, clients, client, build); },
                          [&](const auto& other) { return run(session, client, other); },
                      },
                      next.command);
}

void runOf(ServerClient& client, const ServerClients& clients, game::Session& session,
           const ServerHistory& history) {
    while (!client.commands.empty() && client.decisions.size() < kMaxUntold) {
        const WaitingCommand& next = client.commands.front();
        const bool waitedLong = clients.tick - next.since > kMaxWaitTicks;
        if (!waitedLong && !isReady(session, client, next, clients.settings.maxFillBlocks)) return;
        const bool isEdit =
            std::holds_alternative<Edit>(next.command) || std::holds_alternative<ItemCommand>(next.command);
        if (isEdit && !client.buckets.edits.take(1, clients.now)) return;
        // The number of blocks is known only afterwards.
        if (std::holds_alternative<TakeBack>(next.command) && !client.buckets.blocks.take(1, clients.now))
            return;
        client.waitingBytes -= dataBytes(next);
        const std::uint64_t before = history.lastWrite;
        const Done done = decide(session, clients, client, next);
        const bool isWritten = history.lastWrite != before;
        if (isWritten) {
            client.swungTick = clients.tick;
            client.builtAt = clients.now;
        }
        client.decisions.push_back({isWritten ? history.lastWrite : 0, done, refusedResult(next)});
        client.commands.pop_front();
    }
}

// Loads the chunks around a player who edited recently.
void loadAround(const ServerClient& client, stream::ChunkPipeline& pipeline, Time now) {
    if (!client.builtAt || now - *client.builtAt > kLoadsAround) return;
    for (const world::ChunkPos pos : world::chunksWithin(world::chunkOf(poseOf(client.pose).position), 1))
        if (world::isInWorld(pos)) (void)pipeline.maybeLoadChunkAt(pos);
}

}  // namespace

void enqueueCommand(ServerClients& clients, ServerClient& client, game::Session& session,
                    WaitingCommand command) {
    client.waitingBytes += dataBytes(command);
    if (client.commands.size() >= kMaxWaitingCommands || client.waitingBytes > kMaxWaitingBytes)
        return refuse(clients, client, Refusal::TooMuch, "too many changes of blocks at once");
    // Requests its chunks now: they may be loaded by the next tick but one.
    if (!std::holds_alternative<TakeBack>(command.command))
        (void)isReady(session, client, command, clients.settings.maxFillBlocks);
    client.commands.push_back(std::move(command));
}

Build buildFrom(const Place& place, ClientBuckets& buckets, const world::BlockRegistry& blocks, Time now) {
    auto structure = std::make_shared<world::Structure>();
    if (buckets.edits.take(kEditsOfPlace, now))
        if (auto decoded = store::decodeStructure(place.structure, kMaxPlacedBytes);
            decoded && dataBytes(*decoded) <= kMaxPlacedData)
            *structure = std::move(*decoded);
    dropOtherData(*structure, blocks);
    return {place.number, game::PlaceStructure{std::move(structure), place.low}};
}

void runCommands(ServerClients& clients, game::Session& session, const ServerHistory& history) {
    const auto ticksAround = static_cast<std::uint64_t>(kLoadAroundEvery / kServerTick);
    forEachPlaying(clients, [&](ServerClient& client) {
        runOf(client, clients, session, history);
        if ((clients.tick + client.id) % ticksAround == 0)
            loadAround(client, session.pipeline(), clients.now);
    });
}

void sendDecisions(ServerClients& clients, std::uint64_t durable) {
    forEachPlaying(clients, [&](ServerClient& client) {
        for (; !client.decisions.empty() && client.decisions.front().write <= durable;
             client.decisions.pop_front())
            send(client, client.decisions.front().done);
    });
}

}  // namespace terrane::net
