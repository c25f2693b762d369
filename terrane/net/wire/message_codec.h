// Encodes and decodes a variant of messages from one description of each; for client_message.cpp and
// server_message.cpp only. Any thread.
//
// A description is a function of a wire (WireWriter or WireReader) and a message, const when it is written.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "terrane/base/result.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {

// Definitions shared by client and server messages: limits, keys, numbers. Plain values.
constexpr std::uint32_t kMagic = 0x4E524554;  // "TERN"
constexpr std::uint16_t kProtocolVersion = 4;

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

// T, or const T when it is written.
template <class M, class T>
concept Of = std::same_as<std::remove_const_t<M>, T>;

template <class Variant, class Describe>
Bytes encodeVariant(const Variant& message, Describe describe) {
    Bytes bytes;
    WireWriter wire(bytes);
    wire.fixed(static_cast<std::uint8_t>(message.index()));
    std::visit([&](const auto& m) { describe(wire, m); }, message);
    return bytes;
}

template <class Variant, std::size_t... I>
void emplaceAt(Variant& message, std::size_t index, std::index_sequence<I...>) {
    ((index == I ? void(message.template emplace<I>()) : void()), ...);
}

// `names`: names of the message types, for errors.
template <class Variant, std::size_t kNames, class Describe>
base::Result<Variant> decodeVariant(ByteView bytes, const std::string_view (&names)[kNames],
                                    Describe describe) {
    static_assert(kNames == std::variant_size_v<Variant>, "kClientNames and kServerNames name every message");
    WireReader wire(bytes);
    std::uint8_t type = 0;
    wire.fixed(type);
    if (wire.hasFailed()) return base::fail(base::ErrorCode::Damaged, "an empty message");
    if (type >= kNames) return base::fail(base::ErrorCode::Damaged, "unknown message type {}", type);
    Variant message;
    emplaceAt(message, type, std::make_index_sequence<std::variant_size_v<Variant>>());
    std::visit([&](auto& m) { describe(wire, m); }, message);
    if (!wire.isComplete())
        return base::fail(base::ErrorCode::Damaged, "{} bytes are not a valid {} message", bytes.size(),
                          names[type]);
    return message;
}

}  // namespace terrane::net
