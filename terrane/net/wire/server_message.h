// Messages from a server to a client: plain values, and their encoding. docs/protocol.md describes each
// message to the byte. Any thread.
//
// A message is a byte with its type, the index in the variant below, followed by its fields. The variant's
// order is part of the protocol: changing it requires a new protocol version.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "terrane/base/match.h"
#include "terrane/base/result.h"
#include "terrane/game/permissions.h"
#include "terrane/game/player_items.h"
#include "terrane/net/server/known_players.h"
#include "terrane/net/wire/chunk_difference.h"
#include "terrane/net/wire/message_codec.h"
#include "terrane/net/wire/wire.h"
#include "terrane/net/wire/world_proof.h"

namespace terrane::net {

// Answers Hello.
struct Greeting {
    std::string program;
    Nonce nonce{};  // of this connection
    bool needsPassword = false;
};
// A content pack of the world. `hash`: SHA-256 of its contents (docs/protocol.md); `bytes`: size of the
// archive.
struct PackOffer {
    std::string name, version;
    std::array<std::byte, 32> hash{};
    std::uint32_t bytes = 0;
    bool operator==(const PackOffer&) const = default;
};
// Answers Login.
struct WorldOffer {
    WorldFingerprint world;
    SamplePositions samples{};
    std::vector<PackOffer> packs;  // beside the built-in one, in the order of loading
};
struct Joined {
    game::PlayerId player = 0;
    game::Role role = game::Role::Player;
    std::uint8_t maxViewDistance = 0;
    WirePose pose;  // where the player was when it left
};
struct Refused {
    Refusal why = Refusal::ProtocolError;
    std::string reason;  // one line for the player
};
// The difference of a chunk, or of a tile of a higher level, from its generated state. Sent in parts: the
// first replaces the previous difference.
struct ChunkEdits {
    world::ChunkPos chunk;
    bool isFirst = true;
    ChunkDifference blocks;
};
// Blocks that changed since ChunkEdits.
struct BlocksChanged {
    world::ChunkPos chunk;
    ChunkDifference blocks;
};
// All edits in the view around `center` were sent.
struct ViewComplete {
    world::ChunkPos center;
};
// The result of a command. Its edits are durable on the server.
struct Done {
    CommandNumber number = 0;
    std::uint8_t result = 0;  // game::EditResult, BuildOutcome::Result or UndoResult::Outcome, by the command
    std::uint32_t changed = 0, kept = 0;  // blocks; 0 for Edit
};
// A player comes into sight. `slot` identifies it in Poses until Disappears.
struct Appears {
    std::uint16_t slot = 0;
    game::PlayerId player = 0;
    std::string name;
    WirePose pose;
};
struct Disappears {
    std::uint16_t slot = 0;
};
struct Poses {
    std::vector<PoseChange> changes;
};
// A line of chat; without a name it is from the server.
struct Said {
    std::string name, text;
};
struct Clock {
    double timeDay = 0;  // 0 to 1
    double daysASecond = 0;
};
// Sets the player's pose after a rejected move.
struct Corrected {
    WirePose pose;
};
struct Ping {
    std::uint32_t time = 0;
};
struct ListedPlayer {
    std::string name;
    game::Role role = game::Role::Player;
    std::uint16_t latencyMs = 0;  // 65535: that or more
};
struct PlayerList {
    std::vector<ListedPlayer> players;
};
// The player's role from now on.
struct RoleChanged {
    game::Role role = game::Role::Player;
};

// Other servers of the same world, to connect to if this one stops.
struct Servers {
    struct Place {
        std::string address, key;  // "host:port"; hash of its public key
    };
    std::vector<Place> places;
};

// Answers AskPack.
struct PackPart {
    std::uint8_t number = 0;
    std::uint32_t offset = 0;
    Bytes data;  // at most kMaxPackPart
};

// The mode and the items of the player from now on, in game::kPlayerSlots slots.
struct Items {
    game::Mode mode = game::Mode::Creative;
    world::Inventory slots;
};

using ServerMessage = std::variant<Greeting, WorldOffer, Joined, Refused, ChunkEdits, BlocksChanged,
                                   ViewComplete, Done, Appears, Disappears, Poses, Said, Clock, Corrected,
                                   Ping, PlayerList, RoleChanged, Servers, PackPart, Items>;

// Messages about the connection, and about the world and who plays in it.
template <class Message>
concept OfConnection = base::OneOf<Message, Greeting, WorldOffer, PackPart, Refused, Ping, Servers>;
template <class Message>
concept OfWorld = !OfConnection<Message>;

Bytes encode(const ServerMessage& message);
// Accepts any bytes. The error for an invalid message names the type that it claims to be.
[[nodiscard]] base::Result<ServerMessage> decodeServerMessage(ByteView bytes);

}  // namespace terrane::net
