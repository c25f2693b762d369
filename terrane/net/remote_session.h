// Whether a client can play in the world that a server offers, and what its session is made of. Any thread.
#pragma once

#include <memory>

#include "terrane/game/session.h"
#include "terrane/net/remote_store.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

// One line that says why this program cannot play there; no error where it can.
[[nodiscard]] base::Result<void> checkOffer(const WorldOffer& offer, const world::BlockRegistry& blocks);

// The session's store is told by ClientWorld; it lives as long as the session.
struct RemoteSessionParts {
    game::SessionParts parts;
    RemoteStore* store = nullptr;
};
// After checkOffer().
[[nodiscard]] base::Result<RemoteSessionParts> remoteSessionParts(
    const store::WorldIdentity& identity, std::unique_ptr<const world::BlockRegistry> blocks,
    unsigned threads);

}  // namespace terrane::net
