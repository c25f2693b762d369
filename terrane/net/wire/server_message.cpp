#include "terrane/net/wire/server_message.h"

#include <bit>

#include "terrane/net/wire/message_codec.h"

namespace terrane::net {
namespace {

constexpr std::string_view kServerNames[] = {
    "Greeting", "WorldOffer", "Joined",      "Refused", "ChunkEdits", "BlocksChanged", "ViewComplete",
    "Done",     "Appears",    "Disappears",  "Poses",   "Said",       "Clock",         "Corrected",
    "Ping",     "PlayerList", "RoleChanged", "Servers", "PackPart",   "Items"};

template <class Wire, Of<double> T>
void describeDouble(Wire& wire, T& value) {
    auto bits = std::bit_cast<std::uint64_t>(value);
    wire.fixed(bits);
    if constexpr (Wire::kReads) value = std::bit_cast<double>(bits);
}

void describe(auto& wire, Of<Greeting> auto& m) {
    wire.text(m.program, kMaxProgramBytes);
    wire.array(m.nonce);
    wire.flag(m.needsPassword);
}

void describe(auto& wire, Of<WorldOffer> auto& m) {
    wire.fixed(m.world.identity.seed);
    wire.text(m.world.identity.generator, kMaxGeneratorBytes);
    wire.integer(m.world.identity.generatorVersion);
    wire.integer(m.world.identity.heights.bottom);
    wire.integer(m.world.identity.heights.top);
    wire.require(world::isValid(m.world.identity.heights));
    wire.fixed(m.world.graph);
    wire.fixed(m.world.blocks);
    for (auto& pos : m.samples) describeChunkPos(wire, pos);
    wire.list(m.packs, kMaxPacks, [&](auto& pack) {
        wire.text(pack.name, kMaxPackNameBytes);
        wire.text(pack.version, kMaxPackNameBytes);
        wire.array(pack.hash);
        wire.fixed(pack.bytes);
    });
}

void describe(auto& wire, Of<Joined> auto& m) {
    wire.number(m.player);
    wire.choice(m.role, game::Role::Count);
    wire.fixed(m.maxViewDistance);
    describePose(wire, m.pose);
}

void describe(auto& wire, Of<Refused> auto& m) {
    wire.choice(m.why, Refusal::Count);
    wire.text(m.reason, kMaxReasonBytes);
}

template <class Wire>
void describeBlocks(Wire& wire, auto& blocks) {
    if constexpr (Wire::kReads)
        readBlocks(wire, blocks);
    else
        writeBlocks(wire, blocks);
}

void describe(auto& wire, Of<ChunkEdits> auto& m) {
    describeChunkPos(wire, m.chunk);
    wire.flag(m.isFirst);
    describeBlocks(wire, m.blocks);
}

void describe(auto& wire, Of<BlocksChanged> auto& m) {
    describeChunkPos(wire, m.chunk);
    describeBlocks(wire, m.blocks);
}

void describe(auto& wire, Of<ViewComplete> auto& m) {
    wire.integer(m.center.x);
    wire.integer(m.center.y);
}

void describe(auto& wire, Of<Done> auto& m) {
    wire.number(m.number);
    wire.fixed(m.result);
    wire.number(m.changed);
    wire.number(m.kept);
}

void describe(auto& wire, Of<Appears> auto& m) {
    wire.number(m.slot);
    wire.number(m.player);
    wire.text(m.name, kMaxNameBytes);
    describePose(wire, m.pose);
}

void describe(auto& wire, Of<Disappears> auto& m) {
    wire.number(m.slot);
}

// A player who looks around often stands still: a byte of flags says whether the position changed and whether
// the arm swings.
template <class Wire>
void describeChange(Wire& wire, auto& change) {
    constexpr std::uint8_t kMoves = 1, kSwings = 2;
    wire.number(change.slot);
    std::uint8_t fields = 0;
    if constexpr (!Wire::kReads) {
        if (change.dx != 0 || change.dy != 0 || change.dz != 0) fields |= kMoves;
        if (change.swings) fields |= kSwings;
    }
    wire.fixed(fields);
    wire.require(fields <= (kMoves | kSwings));
    if (fields & kMoves) {
        wire.integer(change.dx);
        wire.integer(change.dy);
        wire.integer(change.dz);
        wire.require(change.dx != 0 || change.dy != 0 || change.dz != 0);
        for (const std::int64_t step : {change.dx, change.dy, change.dz})
            wire.require(step >= -2 * kMaxPosePosition && step <= 2 * kMaxPosePosition);
    }
    wire.fixed(change.yaw);
    wire.fixed(change.pitch);
    if constexpr (Wire::kReads) change.swings = fields & kSwings;
}

void describe(auto& wire, Of<Poses> auto& m) {
    wire.list(m.changes, kMaxPlayersInMessage, [&](auto& change) { describeChange(wire, change); });
}

void describe(auto& wire, Of<Said> auto& m) {
    wire.text(m.name, kMaxNameBytes);
    wire.text(m.text, kMaxChatBytes);
}

void describe(auto& wire, Of<Clock> auto& m) {
    describeDouble(wire, m.timeDay);
    describeDouble(wire, m.daysASecond);
    wire.require(m.timeDay >= 0 && m.timeDay < 1 && m.daysASecond >= 0 && m.daysASecond <= 1);
}

void describe(auto& wire, Of<Corrected> auto& m) {
    describePose(wire, m.pose);
}

void describe(auto& wire, Of<Ping> auto& m) {
    wire.fixed(m.time);
}

void describe(auto& wire, Of<PlayerList> auto& m) {
    wire.list(m.players, kMaxPlayersInMessage, [&](auto& player) {
        wire.text(player.name, kMaxNameBytes);
        wire.choice(player.role, game::Role::Count);
        wire.fixed(player.latencyMs);
    });
}

void describe(auto& wire, Of<Servers> auto& m) {
    wire.list(m.places, kMaxServersInMessage, [&](auto& place) {
        wire.text(place.address, kMaxAddressBytes);
        wire.text(place.key, kServerKeyBytes);
    });
}
void describe(auto& wire, Of<RoleChanged> auto& m) {
    wire.choice(m.role, game::Role::Count);
}

void describe(auto& wire, Of<PackPart> auto& m) {
    wire.fixed(m.number);
    wire.fixed(m.offset);
    wire.data(m.data, kMaxPackPart);
}

void describe(auto& wire, Of<Items> auto& m) {
    wire.choice(m.mode, game::Mode::Count);
    wire.list(m.slots, game::kPlayerSlots, [&](auto& stack) {
        wire.number(stack.count);
        wire.require(stack.count <= world::kMaxStack);
        if (stack.count == 0) return;
        wire.number(stack.wear);
        wire.text(stack.item, world::kMaxItemName);
        wire.require(!stack.item.empty());
    });
    wire.require(m.slots.size() == game::kPlayerSlots);
}

constexpr auto kDescribeServer = [](auto& wire, auto& message) { describe(wire, message); };

}  // namespace

Bytes encode(const ServerMessage& message) {
    return encodeVariant(message, kDescribeServer);
}

base::Result<ServerMessage> decodeServerMessage(ByteView bytes) {
    return decodeVariant<ServerMessage>(bytes, kServerNames, kDescribeServer);
}

}  // namespace terrane::net
