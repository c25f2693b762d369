// What a client and a server say to each other: plain values, and their bytes. docs/protocol.md describes
// each message to the byte. Any thread.
//
// A message is a byte that says which it is, its index in the variant below, then its fields. Messages are
// never taken from the middle of a variant: another protocol has another version.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/game/build_command.h"
#include "terrane/net/chunk_difference.h"
#include "terrane/net/people.h"
#include "terrane/net/wire_pose.h"
#include "terrane/net/world_proof.h"

namespace terrane::net {

constexpr std::uint32_t kMagic = 0x4E524554;  // "TERN"
constexpr std::uint16_t kProtocolVersion = 1;

constexpr std::size_t kMaxPasswordBytes = 128;
constexpr std::size_t kMaxChatBytes = 400;
constexpr std::size_t kMaxReasonBytes = 400;
constexpr std::size_t kMaxGeneratorBytes = 64;  // a generator's name
constexpr std::size_t kMaxProgramBytes = 64;    // a program's name and version
constexpr std::size_t kMaxPlayersInMessage = 4096;
// Of a message with its type. A structure of 32 KiB is some 10,000 blocks of a building.
constexpr std::size_t kMaxStructureWire = 32768;
constexpr std::size_t kMaxClientMessage = 65536;
constexpr std::size_t kMaxServerMessage = 262144;

using Signature = std::array<std::byte, 64>;
using Nonce = std::array<std::byte, 32>;

// Numbers of a client's commands, in ascending order.
using CommandNumber = std::uint32_t;

using game::Role;

// Why a server does not let a client in, or closes a connection.
enum class Refusal : std::uint8_t {
    Version,     // another version of the protocol
    Name,        // no name, or one that another key has
    Password,    // wrong
    WrongKey,    // the signature does not fit the key
    OtherWorld,  // the client's program generates another world
    Banned,
    Full,      // as many players as the server takes
    Disorder,  // a message that is none, or not at this time
    TooMuch,   // more messages than one player may send
    TooSlow,   // what the server sends is not read
    Silent,    // nothing came for too long
    Replaced,  // the same player came again elsewhere
    Kicked,
    Stopping,  // the server ends
    Count,
};

// ---- from the client ----

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
    std::array<std::uint64_t, kSampleChunks> digests{};
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

using ClientMessage =
    std::variant<Hello, Login, Proof, View, Move, Edit, Fill, Place, TakeBack, Say, Pong, AskPlayers, Leave>;

// ---- from the server ----

// Answers Hello.
struct Greeting {
    std::string program;
    Nonce nonce{};  // of this connection
    bool needsPassword = false;
};
// Answers Login.
struct WorldOffer {
    WorldFingerprint world;
    std::array<world::ChunkPos, kSampleChunks> samples{};
};
struct Joined {
    game::PlayerId player = 0;
    Role role = Role::Player;
    std::uint8_t maxViewDistance = 0;
    WirePose pose;  // where the player was when it left
};
struct Refused {
    Refusal why = Refusal::Disorder;
    std::string reason;  // one line for the player
};
// The difference of a chunk from the generator's, or of a tile of a higher level. It comes in parts: the
// first replaces what the client knew.
struct ChunkEdits {
    world::ChunkPos chunk;
    bool isFirst = true;
    ChunkDifference blocks;
};
// Blocks that changed since.
struct BlocksChanged {
    world::ChunkPos chunk;
    ChunkDifference blocks;
};
// All edits in view came, up to here.
struct ViewComplete {
    world::ChunkPos center;
};
// What became of a command. It is in the server's file: no crash loses it.
struct Done {
    CommandNumber number = 0;
    std::uint8_t result = 0;  // game::EditResult, BuildOutcome::Result or TakenBack::Outcome, by the command
    std::uint32_t changed = 0, kept = 0;  // blocks, of what is no edit
};
// A player comes in sight. `slot` stands for it in Poses until it is gone.
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
// A line of chat, or of the server (no name).
struct Said {
    std::string name, text;
};
struct Clock {
    double timeDay = 0;  // 0 to 1
    double daysASecond = 0;
};
// The player stands elsewhere than it said.
struct Corrected {
    WirePose pose;
};
struct Ping {
    std::uint32_t time = 0;
};
struct ListedPlayer {
    std::string name;
    Role role = Role::Player;
    std::uint16_t latencyMs = 0;  // 65535: that and more
};
struct PlayerList {
    std::vector<ListedPlayer> players;
};

using ServerMessage =
    std::variant<Greeting, WorldOffer, Joined, Refused, ChunkEdits, BlocksChanged, ViewComplete, Done,
                 Appears, Disappears, Poses, Said, Clock, Corrected, Ping, PlayerList>;

Bytes encode(const ClientMessage& message);
Bytes encode(const ServerMessage& message);
// Any bytes may be given: what is no message is an error that says which part is wrong.
[[nodiscard]] base::Result<ClientMessage> decodeClientMessage(ByteView bytes);
[[nodiscard]] base::Result<ServerMessage> decodeServerMessage(ByteView bytes);

// For logs: "Hello", "Edit".
std::string_view nameOf(const ClientMessage& message);

// What a player signs to show that it has the key: good for this connection alone. `channel`: the TLS
// connection's exported keying material (RFC 9266), which a server between client and server does not share.
Bytes loginText(ByteView channel, const Nonce& nonce, const std::string& name);

}  // namespace terrane::net
