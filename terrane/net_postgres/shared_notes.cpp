#include "terrane/net_postgres/shared_notes.h"

#include <charconv>

#include "terrane/base/text.h"
#include "terrane/game/places.h"
#include "terrane/net/wire/message_codec.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net_postgres {
namespace {

constexpr char kHexDigits[] = "0123456789abcdef";

// One description for reading and writing each type (net/wire.h).
template <class Wire, class N>
void describe(Wire& wire, N& note) {
    using T = std::remove_const_t<N>;
    if constexpr (requires { note.player; }) {
        wire.number(note.player);
    } else if constexpr (std::is_same_v<T, TimeNote>) {
        wire.fixed(note.timeDay);
    } else if constexpr (std::is_same_v<T, PlaceNote>) {
        wire.text(note.change.name, game::kMaxPlaceName);
        net::describePose(wire, note.change.pose);
        wire.flag(note.change.isGone);
    } else if constexpr (std::is_same_v<T, LineNote>) {
        wire.text(note.line.name, net::kMaxNameBytes);
        wire.text(note.line.text, net::kMaxChatBytes);
    } else if constexpr (std::is_same_v<T, PosesNote>) {
        wire.list(note.players, kMaxPosesInNote, [&](auto& player) {
            wire.number(player.id);
            net::describePose(wire, player.pose);
            wire.flag(player.swings);
        });
    } else if constexpr (std::is_same_v<T, TilesNote>) {
        wire.list(note.tiles, kMaxTilesInNote, [&](auto& tile) { net::describeChunkPos(wire, tile); });
    }
}

std::optional<net::Bytes> fromHex(std::string_view text) {
    if (text.size() % 2 != 0) return std::nullopt;
    net::Bytes bytes;
    bytes.reserve(text.size() / 2);
    for (std::size_t at = 0; at < text.size(); at += 2) {
        const auto byte = base::hexByte(text[at], text[at + 1]);
        if (!byte) return std::nullopt;
        bytes.push_back(static_cast<std::byte>(*byte));
    }
    return bytes;
}

template <std::size_t I = 0>
std::optional<Note> noteOfKind(std::size_t kind, net::ByteView bytes) {
    if constexpr (I == std::variant_size_v<Note>) {
        return std::nullopt;
    } else {
        if (kind != I) return noteOfKind<I + 1>(kind, bytes);
        std::variant_alternative_t<I, Note> note{};
        net::WireReader wire(bytes);
        describe(wire, note);
        return wire.isComplete() ? std::optional<Note>(std::move(note)) : std::nullopt;
    }
}

}  // namespace

bool isOfRows(const Note& note) {
    return std::holds_alternative<PlayerNote>(note) || std::holds_alternative<ClaimsNote>(note) ||
           std::holds_alternative<PasswordNote>(note);
}

std::string noteText(std::int64_t server, const Note& note) {
    net::Bytes bytes;
    net::WireWriter wire(bytes);
    std::visit([&](const auto& kind) { describe(wire, kind); }, note);
    std::string text = fmt::format("{}{:c}", server, static_cast<char>('a' + note.index()));
    for (const std::byte byte : bytes) {
        text += kHexDigits[std::to_integer<int>(byte) >> 4];
        text += kHexDigits[std::to_integer<int>(byte) & 15];
    }
    return text;
}

std::optional<ReadNote> readNote(std::string_view text) {
    ReadNote read;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, read.server);
    if (error != std::errc() || next == end || *next < 'a') return std::nullopt;
    const auto bytes = fromHex(std::string_view(next + 1, static_cast<std::size_t>(end - next - 1)));
    if (!bytes) return std::nullopt;
    auto note = noteOfKind(static_cast<std::size_t>(*next - 'a'), *bytes);
    if (!note) return std::nullopt;
    read.note = std::move(*note);
    return read;
}

}  // namespace terrane::net_postgres
