// A client's half of the login (docs/protocol.md), without sockets: what to say to what a server says, until
// the player is in the world. Plain values and functions; any thread.
#pragma once

#include <optional>
#include <string>

#include "terrane/net/client_message.h"
#include "terrane/net/keys.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

// Who logs in.
struct ClientIdentity {
    std::string name;
    PlayerKey key;
    std::string password;  // empty: none
    std::string program;   // and its version
};

Hello helloOf(const ClientIdentity& identity);
// Answers a Greeting. `channel`: the connection's keying material.
Login loginOf(const ClientIdentity& identity, const Greeting& greeting, ByteView channel);

// Whether it may help to come again soon: nothing about the player or its program is wrong.
constexpr bool isWorthReturning(Refusal why) {
    return why == Refusal::Stopping || why == Refusal::Silent || why == Refusal::TooSlow ||
           why == Refusal::Full;
}

}  // namespace terrane::net
