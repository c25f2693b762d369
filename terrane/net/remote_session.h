// Whether a client can play in the world that a server offers, and what its session is made of. Any thread.
#pragma once

#include <memory>

#include "terrane/game/session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/net/remote_store.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

// The generator of the world that is offered. Where this program makes another world the error is one line
// that says what differs. `generators`: those that this program has.
[[nodiscard]] base::Result<gen::Generator> offeredGenerator(
    const WorldOffer& offer, const world::BlockRegistry& blocks,
    const gen::GeneratorCatalogue& generators = gen::builtInGenerators());

// The session's store is told by ClientWorld; it lives as long as the session.
struct RemoteSessionParts {
    game::SessionParts parts;
    RemoteStore* store = nullptr;
};
// After offeredGenerator().
[[nodiscard]] base::Result<RemoteSessionParts> remoteSessionParts(
    const store::WorldIdentity& identity, std::shared_ptr<const world::BlockRegistry> blocks,
    unsigned threads, const gen::GeneratorCatalogue& generators = gen::builtInGenerators());

}  // namespace terrane::net
