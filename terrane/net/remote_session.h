// Checks whether a client can play in an offered world, and makes the parts of its session. Any thread.
#pragma once

#include <memory>

#include "terrane/game/session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/net/remote_store.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

// The generator of the offered world. If this program generates another world, the error says in one line how
// they differ. `generators`: the generators of this program.
[[nodiscard]] base::Result<gen::Generator> offeredGenerator(
    const WorldOffer& offer, const world::BlockRegistry& blocks,
    const gen::GeneratorCatalogue& generators = gen::builtInGenerators());

// `store` is owned by `parts`, then by the session; ClientWorld updates it.
struct RemoteSessionParts {
    game::SessionParts parts;
    RemoteStore* store = nullptr;
};
// Call after offeredGenerator() succeeded.
[[nodiscard]] base::Result<RemoteSessionParts> remoteSessionParts(
    const store::WorldIdentity& identity, std::shared_ptr<const world::BlockRegistry> blocks,
    unsigned threads, const gen::GeneratorCatalogue& generators = gen::builtInGenerators());

}  // namespace terrane::net
