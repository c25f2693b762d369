// Messages from a client to a server: plain values, and their encoding. docs/protocol.md describes each
// message to the byte. Any thread.
//
// A message is a byte with its type, the index in the variant below, followed by its fields. The variant's
// order is part of the protocol: changing it requires a new protocol version.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "terrane/base/match.h"
#include "terrane/base/result.h"
#include "terrane/game/build_command.h"
#include "terrane/game/player_items.h"
#include "terrane/net/wire/message_codec.h"
#include "terrane/net/wire/security.h"
#include "terrane/net/wire/wire.h"
#include "terrane/net/wire/world_proof.h"

namespace terrane::net {

struct Hello {
    std::uint32_t magic = kMagic;
    std::uint16_t version = kProtocolVersion;
    std::string program;  // and its version, for the server's log
};
// Answers Greeting. The signature is over loginText().
struct Login {
    std::string name;
    PublicKey key{};
    Signature signature{};
    std::string password;  // empty: none
};
// Answers WorldOffer: the digests of the chunks that it names.
struct Proof {
    SampleDigests digests{};
};
// The view of the client: the server sends edits of chunks up to `viewDistance` (chunks) around `center`, and
// of tiles up to `horizon` (chunks), in blocks from z = `lowest` up.
struct View {
    world::ChunkPos center;
    std::uint8_t viewDistance = 0;
    std::uint16_t horizon = 0;
    std::int32_t lowest = world::kLowestBottom;

    bool operator==(const View&) const = default;
};
struct Move {
    WirePose pose;
};
struct Edit {
    CommandNumber number = 0;
    world::BlockPos pos;
    world::BlockChange change;
    std::optional<world::BlockId> expected;
};
struct Fill {
    CommandNumber number = 0;
    game::FillBox fill;
};
struct Place {
    CommandNumber number = 0;
    world::BlockPos low;
    Bytes structure;  // as store::encodeStructure() gives it
};
struct TakeBack {
    CommandNumber number = 0;
    bool isRedo = false;
};
struct Say {
    std::string text;
};
// Answers Ping.
struct Pong {
    std::uint32_t time = 0;
};
// Asks for PlayerList.
struct AskPlayers {};
struct Leave {};
// Asks for PackPart: the next bytes of the pack with this index in WorldOffer. Sent before Proof.
struct AskPack {
    std::uint8_t number = 0;
    std::uint32_t offset = 0;
};
// An action with the player's items, answered by Done; Items tells what became of them.
struct ItemCommand {
    CommandNumber number = 0;
    game::ItemAction action;
};

using ClientMessage = std::variant<Hello, Login, Proof, View, Move, Edit, Fill, Place, TakeBack, Say, Pong,
                                   AskPlayers, Leave, AskPack, ItemCommand>;

// Messages of a client before it plays, and while it plays.
template <class Message>
concept OfLogin = base::OneOf<Message, Hello, Login, Proof, AskPack>;
template <class Message>
concept OfPlay = !OfLogin<Message>;

Bytes encode(const ClientMessage& message);
// Accepts any bytes. The error for an invalid message names the type that it claims to be.
[[nodiscard]] base::Result<ClientMessage> decodeClientMessage(ByteView bytes);

// For logs: "Hello", "Edit".
std::string_view nameOf(const ClientMessage& message);

// The text that a player signs to prove that it has the key; valid for this connection only. `channel`: the
// TLS connection's exported keying material (RFC 9266), which differs on both sides of a man in the middle.
Bytes loginText(ByteView channel, const Nonce& nonce, const std::string& name);

// The chunks and tiles whose edits a client receives, as server and client both compute them. Any thread.
// A tile is sent if its distance is in this range, in widths of the tile (Chebyshev): nearer tiles are never
// drawn (docs/levels.md), and at the finest detail no tile is farther away.
constexpr int kNearestTile = 3, kFarthestTile = 33;

// What a server gives a client that asks for a view.
View servedView(const View& asked, int maxViewDistance);

// The coarsest level of the view's tiles; 0: it has none.
int topLevelOf(const View& view);

// `margin`: chunks or tiles beyond the view that count too.
bool isInView(const View& view, world::ChunkPos pos, int margin = 0);

}  // namespace terrane::net
