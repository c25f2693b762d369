// Encodes and decodes a variant of messages from one description of each; for client_message.cpp and
// server_message.cpp only. Any thread.
//
// A description is a function of a wire (WireWriter or WireReader) and a message, const when it is written.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "terrane/base/result.h"
#include "terrane/net/wire.h"

namespace terrane::net {

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
template <class Variant, class Describe>
base::Result<Variant> decodeVariant(ByteView bytes,
                                    std::span<const std::string_view, std::variant_size_v<Variant>> names,
                                    Describe describe) {
    WireReader wire(bytes);
    std::uint8_t type = 0;
    wire.fixed(type);
    if (wire.hasFailed()) return base::fail(base::ErrorCode::Damaged, "an empty message");
    if (type >= names.size()) return base::fail(base::ErrorCode::Damaged, "unknown message type {}", type);
    Variant message;
    emplaceAt(message, type, std::make_index_sequence<std::variant_size_v<Variant>>());
    std::visit([&](auto& m) { describe(wire, m); }, message);
    if (!wire.isComplete())
        return base::fail(base::ErrorCode::Damaged, "{} bytes are not a valid {} message", bytes.size(),
                          names[type]);
    return message;
}

}  // namespace terrane::net
