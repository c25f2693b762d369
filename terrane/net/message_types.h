// What messages of clients and of servers have in common: limits, keys, numbers. Plain values.
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
// Of a message with its type. A structure of 32 KiB is some 10,000 blocks of a building.
constexpr std::size_t kMaxStructureWire = 32768;
constexpr std::size_t kMaxClientMessage = 65536;
constexpr std::size_t kMaxServerMessage = 262144;

using Nonce = std::array<std::byte, 32>;

// Numbers of a client's commands, in ascending order.
using CommandNumber = std::uint32_t;

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

}  // namespace terrane::net
