#include "terrane/net/wire/client_message.h"

#include <algorithm>

#include "terrane/net/wire/chunk_difference.h"
#include "terrane/net/wire/message_codec.h"
#include "terrane/stream/tile_table.h"

namespace terrane::net {

namespace {

constexpr std::string_view kClientNames[] = {"Hello", "Login",      "Proof", "View",     "Move",
                                             "Edit",  "Fill",       "Place", "TakeBack", "Say",
                                             "Pong",  "AskPlayers", "Leave", "AskPack",  "ItemCommand"};

// Kinds of changes to a block, in the order of the encoding.
enum class ChangeKind : std::uint8_t { SetBlock, SetEntityData, UseBlock, Count };

void describePos(auto& wire, Of<world::BlockPos> auto& pos) {
    wire.integer(pos.x);
    wire.integer(pos.y);
    wire.integer(pos.z);
    wire.require(pos.z >= world::kLowestBottom && pos.z < world::kHighestTop);
}

void describe(auto& wire, Of<Hello> auto& m) {
    wire.fixed(m.magic);
    wire.require(m.magic == kMagic);
    wire.fixed(m.version);
    // Magic and version are the same in all protocol versions: a newer client gets Refusal::Version whatever
    // follows.
    if (m.version != kProtocolVersion) return wire.ignoreRest();
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
    wire.integer(m.lowest);
    wire.require(m.lowest >= world::kLowestBottom && m.lowest <= world::kHighestTop);
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
    wire.choice(m.fill.shape.kind, game::ShapeKind::Count);
    wire.flag(m.fill.shape.fromHighX);
    wire.flag(m.fill.shape.fromHighY);
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

void describe(auto& wire, Of<AskPack> auto& m) {
    wire.fixed(m.number);
    wire.fixed(m.offset);
}

void describePlace(auto& wire, Of<game::SlotPlace> auto& place) {
    wire.optional(place.block, [&](auto& pos) { describePos(wire, pos); });
    wire.number(place.slot);
}

void describeAction(auto& wire, Of<game::MoveStack> auto& move) {
    describePlace(wire, move.from);
    describePlace(wire, move.to);
    wire.number(move.count);
}

void describeAction(auto& wire, Of<game::CraftItems> auto& craft) {
    wire.optional(craft.workbench, [&](auto& pos) { describePos(wire, pos); });
}

void describeAction(auto&, Of<game::UseItem> auto&) {}

void describeAction(auto& wire, Of<game::SelectSlot> auto& select) {
    wire.fixed(select.slot);
}

template <class Wire>
void describe(Wire& wire, Of<ItemCommand> auto& m) {
    wire.number(m.number);
    auto kind = static_cast<std::uint8_t>(m.action.index());
    wire.fixed(kind);
    constexpr std::size_t kKinds = std::variant_size_v<game::ItemAction>;
    wire.require(kind < kKinds);
    if constexpr (Wire::kReads)
        if (kind < kKinds) emplaceAt(m.action, kind, std::make_index_sequence<kKinds>());
    std::visit([&](auto& action) { describeAction(wire, action); }, m.action);
}

constexpr auto kDescribeClient = [](auto& wire, auto& message) { describe(wire, message); };

}  // namespace

Bytes encode(const ClientMessage& message) {
    return encodeVariant(message, kDescribeClient);
}

base::Result<ClientMessage> decodeClientMessage(ByteView bytes) {
    return decodeVariant<ClientMessage>(bytes, kClientNames, kDescribeClient);
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

View servedView(const View& asked, int maxViewDistance) {
    View view = asked;
    view.viewDistance = static_cast<std::uint8_t>(std::min<int>(asked.viewDistance, maxViewDistance));
    view.horizon = static_cast<std::uint16_t>(std::min<int>(asked.horizon, stream::kMaxHorizon));
    return view;
}

int topLevelOf(const View& view) {
    if (view.horizon == 0) return 0;
    return stream::coarsestLevel({.horizon = view.horizon, .detail = stream::kMinDetail});
}

bool isInView(const View& view, world::ChunkPos pos, int margin) {
    const world::ChunkPos center{view.center.x >> pos.level, view.center.y >> pos.level, pos.level};
    const std::int64_t distance = world::chunkDistance(pos, center);
    // One chunk more than is visible, since meshes depend on their neighbors.
    if (pos.level == 0) return distance <= view.viewDistance + 1 + margin;
    const std::int64_t horizon = (view.horizon >> pos.level) + 1;
    return distance >= kNearestTile - margin &&
           distance <= std::min<std::int64_t>(kFarthestTile, horizon) + margin;
}

}  // namespace terrane::net
