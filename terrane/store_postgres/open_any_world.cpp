#include "terrane/store_postgres/open_any_world.h"

#include <cassert>
#include <utility>

#include "terrane/store_postgres/postgres_store.h"

namespace terrane::store_postgres {

base::Result<std::unique_ptr<store::ChunkStore>> openAnyWorld(const store::WorldLocation& location,
                                                              const world::BlockRegistry& blocks,
                                                              const store::WorldRequest& request) {
    if (location.kind != store::WorldLocation::Kind::Url || !isPostgresUrl(location.text))
        return store::openWorld(location, blocks, request);
    assert(request.versionOf && "the generators of the program decide whether a world fits");
    const auto address = addressOf(location.text);
    if (!address) return tl::unexpected(address.error());
    if (request.access == store::WorldAccess::ReadOnly) {
        auto saved = openReader(*address, blocks, request.limits);
        if (!saved) return tl::unexpected(saved.error());
        return store::openOver(std::move(*saved), request, address->shown);
    }
    store::SaveAccess access{.create = request.create, .decide = {}};
    access.decide = [&](const store::WorldIdentity& saved) {
        return store::compareWorld(saved, request.wanted, request.versionOf, address->shown);
    };
    auto store = PostgresStore::open(*address, blocks, access, request.sharing, request.limits);
    if (!store) return tl::unexpected(store.error());
    return std::move(*store);
}

}  // namespace terrane::store_postgres
