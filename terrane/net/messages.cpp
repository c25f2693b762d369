#include "terrane/net/messages.h"

#include <bit>
#include <concepts>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace terrane::net {
namespace {

// A message to be read, or a const one to be written.
template <class M, class T>
concept Of = std::same_as<std::remove_const_t<M>, T>;

// What a client may do to a block; the order is the one on the wire.
enum class ChangeKind : std::uint8_t { SetBlock, SetEntityData, UseBlock, Count };

template <class Wire, Of<double> T>
void describeDouble(Wire& wire, T& value) {
    auto bits = std::bit_cast<std::uint64_t>(value);
    wire.fixed(bits);
    if constexpr (Wire::kReads) value = std::bit_cast<double>(bits);
}

template <class Wire, Of<game::PlayerId> T>
void describePlayer(Wire& wire, T& player) {
    wire.number(player);
}

void describe(auto& wire, Of<Hello> auto& m) {
    wire.fixed(m.magic);
    wire.require(m.magic == kMagic);
    wire.fixed(m.version);
    // Only this much is the same in all versions: a newer client is told so, whatever follows.
    if (m.version != kProtocolVersion) return;
    wire.text(m.program, kMaxProgramBytes);
}

void describe(auto& wire, Of<Login> auto& m) {
    wire.text(m.name, kMaxNameBytes);
    wire.array(m.key);
    wire.array(m.signature);
    wire.text(m.password, kMaxPasswordBytes);
}

void describe(auto& wire, Of<Proof> auto& m) {
    for (auto& digest : m.digests) wire.fixed(digest);
}

void describe(auto& wire, Of<View> auto& m) {
    wire.integer(m.center.x);
    wire.integer(m.center.y);
    wire.require(world::isInWorld(m.center));
    wire.fixed(m.viewDistance);
    wire.number(m.horizon);
}

void describe(auto& wire, Of<Move> auto& m) {
    describePose(wire, m.pose);
}

template <class Wire>
void writeChange(Wire& wire, const world::BlockChange& change) {
    const auto kind = [&](ChangeKind k) { wire.choice(k, ChangeKind::Count); };
    if (const auto* block = std::get_if<world::SetBlock>(&change)) {
        kind(ChangeKind::SetBlock);
        wire.number(block->id);
        wire.number(block->state);
    } else if (const auto* data = std::get_if<world::SetEntityData>(&change)) {
        kind(ChangeKind::SetEntityData);
        wire.data(data->data, kMaxBlockData);
    } else {
        kind(ChangeKind::UseBlock);
    }
}

void readChange(WireReader& wire, world::BlockChange& change) {
    ChangeKind kind{};
    wire.choice(kind, ChangeKind::Count);
    if (kind == ChangeKind::SetBlock) {
        auto& block = change.emplace<world::SetBlock>();
        wire.number(block.id);
        wire.number(block.state);
    } else if (kind == ChangeKind::SetEntityData) {
        wire.data(change.emplace<world::SetEntityData>().data, kMaxBlockData);
    } else {
        change.emplace<world::UseBlock>();
    }
}

template <class Wire>
void describe(Wire& wire, Of<Edit> auto& m) {
    wire.number(m.number);
    describePos(wire, m.pos);
    if constexpr (Wire::kReads)
        readChange(wire, m.change);
    else
        writeChange(wire, m.change);
    wire.optional(m.expected, [&](auto& id) { wire.number(id); });
}

void describe(auto& wire, Of<Fill> auto& m) {
    wire.number(m.number);
    describePos(wire, m.fill.box.low);
    describePos(wire, m.fill.box.high);
    wire.number(m.fill.id);
    wire.number(m.fill.state);
    wire.optional(m.fill.replaced, [&](auto& id) { wire.number(id); });
}

void describe(auto& wire, Of<Place> auto& m) {
    wire.number(m.number);
    describePos(wire, m.low);
    wire.data(m.structure, kMaxStructureWire);
}

void describe(auto& wire, Of<TakeBack> auto& m) {
    wire.number(m.number);
    wire.flag(m.isRedo);
}

void describe(auto& wire, Of<Say> auto& m) {
    wire.text(m.text, kMaxChatBytes);
}

void describe(auto& wire, Of<Pong> auto& m) {
    wire.fixed(m.time);
}

void describe(auto&, Of<AskPlayers> auto&) {}
void describe(auto&, Of<Leave> auto&) {}

void describe(auto& wire, Of<Greeting> auto& m) {
    wire.text(m.program, kMaxProgramBytes);
    wire.array(m.nonce);
    wire.flag(m.needsPassword);
}

void describe(auto& wire, Of<WorldOffer> auto& m) {
    wire.fixed(m.world.identity.seed);
    wire.text(m.world.identity.generator, kMaxGeneratorBytes);
    wire.integer(m.world.identity.generatorVersion);
    wire.fixed(m.world.graph);
    wire.fixed(m.world.blocks);
    for (auto& pos : m.samples) describeChunkPos(wire, pos);
}

void describe(auto& wire, Of<Joined> auto& m) {
    describePlayer(wire, m.player);
    wire.choice(m.role, Role::Count);
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
    describePlayer(wire, m.player);
    wire.text(m.name, kMaxNameBytes);
    describePose(wire, m.pose);
}

void describe(auto& wire, Of<Disappears> auto& m) {
    wire.number(m.slot);
}

// Who looks about often stands: a byte says whether the player moves, and whether it swings its arm.
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
        wire.choice(player.role, Role::Count);
        wire.fixed(player.latencyMs);
    });
}

template <class Variant>
Bytes encodeVariant(const Variant& message) {
    Bytes bytes;
    WireWriter wire(bytes);
    wire.fixed(static_cast<std::uint8_t>(message.index()));
    std::visit([&](const auto& m) { describe(wire, m); }, message);
    return bytes;
}

constexpr std::string_view kClientNames[] = {"Hello", "Login",      "Proof", "View",     "Move",
                                             "Edit",  "Fill",       "Place", "TakeBack", "Say",
                                             "Pong",  "AskPlayers", "Leave"};
constexpr std::string_view kServerNames[] = {"Greeting",   "WorldOffer",    "Joined",       "Refused",
                                             "ChunkEdits", "BlocksChanged", "ViewComplete", "Done",
                                             "Appears",    "Disappears",    "Poses",        "Said",
                                             "Clock",      "Corrected",     "Ping",         "PlayerList"};
static_assert(std::size(kClientNames) == std::variant_size_v<ClientMessage>);
static_assert(std::size(kServerNames) == std::variant_size_v<ServerMessage>);

template <class Variant, std::size_t... I>
void emplaceAt(Variant& message, std::size_t index, std::index_sequence<I...>) {
    ((index == I ? void(message.template emplace<I>()) : void()), ...);
}

template <class Variant>
base::Result<Variant> decodeVariant(ByteView bytes, std::span<const std::string_view> names) {
    constexpr std::size_t kCount = std::variant_size_v<Variant>;
    WireReader wire(bytes);
    std::uint8_t type = 0;
    wire.fixed(type);
    if (wire.hasFailed()) return base::fail(base::ErrorCode::Damaged, "an empty message");
    if (type >= kCount) return base::fail(base::ErrorCode::Damaged, "no message has the number {}", type);
    Variant message;
    emplaceAt(message, type, std::make_index_sequence<kCount>());
    std::visit([&](auto& m) { describe(wire, m); }, message);
    const auto* hello = std::get_if<0>(&message);
    if constexpr (std::is_same_v<Variant, ClientMessage>)
        if (!wire.hasFailed() && hello && hello->version != kProtocolVersion) return message;
    if (!wire.isComplete())
        return base::fail(base::ErrorCode::Damaged, "{} bytes are no message {}", bytes.size(), names[type]);
    return message;
}

}  // namespace

Bytes encode(const ClientMessage& message) {
    return encodeVariant(message);
}

Bytes encode(const ServerMessage& message) {
    return encodeVariant(message);
}

base::Result<ClientMessage> decodeClientMessage(ByteView bytes) {
    return decodeVariant<ClientMessage>(bytes, kClientNames);
}

base::Result<ServerMessage> decodeServerMessage(ByteView bytes) {
    return decodeVariant<ServerMessage>(bytes, kServerNames);
}

std::string_view nameOf(const ClientMessage& message) {
    return kClientNames[message.index()];
}

Bytes loginText(ByteView channel, const Nonce& nonce, const std::string& name) {
    Bytes text;
    WireWriter wire(text);
    wire.text("terrane login 1", kMaxProgramBytes);
    store::append(text, channel);
    store::append(text, nonce);
    wire.text(name, kMaxNameBytes);
    return text;
}

}  // namespace terrane::net
