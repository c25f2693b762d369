// libFuzzer: any bytes as a message of a client or a server; the first byte selects which. A decoded message
// survives encoding and decoding again.
#include "terrane/net/wire/client_message.h"
#include "terrane/net/wire/server_message.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

// A Hello of another version is read only up to the fields that all versions share.
bool isWhole(const net::ClientMessage& message) {
    const auto* hello = std::get_if<net::Hello>(&message);
    return !hello || hello->version == net::kProtocolVersion;
}
bool isWhole(const net::ServerMessage&) {
    return true;
}

template <class Decode>
void check(net::ByteView bytes, Decode decode) {
    const auto message = decode(bytes);
    if (!message) return fuzz::requireReason(message.error());
    if (!isWhole(*message)) return;
    const net::Bytes again = net::encode(*message);
    fuzz::require(again.size() <= bytes.size());
    const auto back = decode(again);
    fuzz::require(back && net::encode(*back) == again);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const net::ByteView bytes = std::as_bytes(std::span(data + 1, size - 1));
    if (data[0] % 2 == 0)
        check(bytes, net::decodeClientMessage);
    else
        check(bytes, net::decodeServerMessage);
    return 0;
}
