// What a client says to a server: plain values, and their bytes. docs/protocol.md describes each message to
// the byte. Any thread.
//
// A message is a byte that says which it is, its index in the variant below, then its fields. Messages are
// never taken from the middle of a variant: another protocol has another version.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "terrane/base/result.h"
#include "terrane/game/build_command.h"
#include "terrane/net/keys.h"
#include "terrane/net/message_types.h"
#include "terrane/net/wire_pose.h"
#include "terrane/net/world_proof.h"

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
// What the client shows: it gets edits of chunks up to `viewDistance` around `center`, of tiles to `horizon`.
struct View {
    world::ChunkPos center;
    std::uint8_t viewDistance = 0;
    std::uint16_t horizon = 0;
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
// Asks for PackPart: the next bytes of a pack of WorldOffer, by its number there. Before Proof.
struct AskPack {
    std::uint8_t number = 0;
    std::uint32_t offset = 0;
};

using ClientMessage = std::variant<Hello, Login, Proof, View, Move, Edit, Fill, Place, TakeBack, Say, Pong,
                                   AskPlayers, Leave, AskPack>;

Bytes encode(const ClientMessage& message);
// Any bytes may be given: what is no message is an error that names the one it should be.
[[nodiscard]] base::Result<ClientMessage> decodeClientMessage(ByteView bytes);

// For logs: "Hello", "Edit".
std::string_view nameOf(const ClientMessage& message);

// What a player signs to show that it has the key: good for this connection alone. `channel`: the TLS
// connection's exported keying material (RFC 9266), which a server between client and server does not share.
Bytes loginText(ByteView channel, const Nonce& nonce, const std::string& name);

}  // namespace terrane::net
