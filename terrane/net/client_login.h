// The client's side of the login (docs/protocol.md), without sockets: builds the answers to the server's
// messages. Plain values and functions; any thread.
#pragma once

#include <optional>
#include <string>

#include "terrane/net/client_message.h"
#include "terrane/net/keys.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

// The identity that a client logs in with.
struct ClientIdentity {
    std::string name;
    PlayerKey key;
    std::string password;  // empty: none
    std::string program;   // and its version
};

Hello helloOf(const ClientIdentity& identity);
// Answers a Greeting. `channel`: the connection's keying material.
Login loginOf(const ClientIdentity& identity, const Greeting& greeting, ByteView channel);

// Whether reconnecting soon may succeed: the refusal is not about the player or its program.
constexpr bool isWorthReturning(Refusal why) {
    return why == Refusal::Stopping || why == Refusal::Silent || why == Refusal::TooSlow ||
           why == Refusal::Full;
}

}  // namespace terrane::net
