// What a server says to a client: plain values, and their bytes. docs/protocol.md describes each message to
// the byte. Any thread.
//
// A message is a byte that says which it is, its index in the variant below, then its fields. Messages are
// never taken from the middle of a variant: another protocol has another version.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/game/permissions.h"
#include "terrane/net/chunk_difference.h"
#include "terrane/net/message_types.h"
#include "terrane/net/people.h"
#include "terrane/net/wire_pose.h"
#include "terrane/net/world_proof.h"

namespace terrane::net {

// Answers Hello.
struct Greeting {
    std::string program;
    Nonce nonce{};  // of this connection
    bool needsPassword = false;
};
// A content pack of the world. `hash`: SHA-256 of its contents (docs/protocol.md); `bytes`: of the archive.
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
    game::Role role = game::Role::Player;
    std::uint16_t latencyMs = 0;  // 65535: that and more
};
struct PlayerList {
    std::vector<ListedPlayer> players;
};
// What the player may do from here on.
struct RoleChanged {
    game::Role role = game::Role::Player;
};

// Other servers of the same world: where else to go when this one is gone.
struct Servers {
    struct Place {
        std::string address, key;  // "host:port"; by which it is known
    };
    std::vector<Place> places;
};

// Answers AskPack.
struct PackPart {
    std::uint8_t number = 0;
    std::uint32_t offset = 0;
    Bytes data;  // at most kMaxPackPart
};

using ServerMessage = std::variant<Greeting, WorldOffer, Joined, Refused, ChunkEdits, BlocksChanged,
                                   ViewComplete, Done, Appears, Disappears, Poses, Said, Clock, Corrected,
                                   Ping, PlayerList, RoleChanged, Servers, PackPart>;

Bytes encode(const ServerMessage& message);
// Any bytes may be given: what is no message is an error that names the one it should be.
[[nodiscard]] base::Result<ServerMessage> decodeServerMessage(ByteView bytes);

}  // namespace terrane::net
