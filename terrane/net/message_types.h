// Definitions shared by client and server messages: limits, keys, numbers. Plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace terrane::net {

constexpr std::uint32_t kMagic = 0x4E524554;  // "TERN"
constexpr std::uint16_t kProtocolVersion = 2;

constexpr std::size_t kMaxNameBytes = 24;  // of a player or a claim
constexpr std::size_t kMaxPasswordBytes = 128;
constexpr std::size_t kMaxChatBytes = 400;
constexpr std::size_t kMaxReasonBytes = 400;
constexpr std::size_t kMaxGeneratorBytes = 64;  // a generator's name
constexpr std::size_t kMaxProgramBytes = 64;    // a program's name and version
constexpr std::size_t kMaxPlayersInMessage = 4096;
constexpr std::size_t kMaxServersInMessage = 64;
constexpr std::size_t kMaxPacks = 64;          // of a world
constexpr std::size_t kMaxPackNameBytes = 64;  // and of its version
constexpr std::size_t kMaxPackPart = 196608;   // bytes of a pack in a message
constexpr std::size_t kMaxAddressBytes = 256;  // of a server
constexpr std::size_t kServerKeyBytes = 64;    // hexadecimal digits
// Sizes in bytes, including the type byte. A structure of 32 KiB has about 10,000 blocks.
constexpr std::size_t kMaxStructureWire = 32768;
constexpr std::size_t kMaxClientMessage = 65536;
constexpr std::size_t kMaxServerMessage = 262144;

using Nonce = std::array<std::byte, 32>;

// Numbers of a client's commands, ascending.
using CommandNumber = std::uint32_t;

// Why a server refuses a login or closes a connection.
enum class Refusal : std::uint8_t {
    Version,     // another version of the protocol
    Name,        // invalid, or used by another key
    Password,    // wrong password
    WrongKey,    // the signature does not fit the key
    OtherWorld,  // the client's program generates another world
    Banned,
    Full,           // the server has its maximum number of players
    ProtocolError,  // an invalid message, or one that is not allowed at this time
    TooMuch,        // rate limit exceeded
    TooSlow,        // the client does not read fast enough
    Silent,         // no message for too long
    Replaced,       // the same player logged in from elsewhere
    Kicked,
    Stopping,  // the server shuts down
    Count,
};

}  // namespace terrane::net
