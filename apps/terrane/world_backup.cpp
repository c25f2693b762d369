#include "apps/terrane/world_backup.h"

#include <utility>

#include "terrane/io/open_session.h"
#include "terrane/net/server/server_loop.h"
#include "terrane/net/server/sqlite_records.h"
#include "terrane/net_postgres/world_records.h"

namespace terrane::app {
namespace {

base::Result<void> copyFile(const std::filesystem::path& world, const world::BlockRegistry& blocks,
                            const std::filesystem::path& save, const store::CopyProgress& progress) {
    const auto copy = TERRANE_TRY(net::copySaved(world, blocks));
    TERRANE_TRY(copy.world(save, progress));
    if (!copy.records) return {};
    return copy.records(store::serverFilePath(save), progress);
}

// The chunks may lack edits at the end of the history: adds them, as a server does that opens the world.
base::Result<void> addEndOfHistory(const io::WorldOptions& given, const std::filesystem::path& save) {
    const std::filesystem::path file = store::serverFilePath(save);
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    const auto ends = TERRANE_TRY(store::readHistoryEnds(file));
    if (ends.saved >= ends.newest) return {};
    io::WorldOptions options = given;
    io::SaveOptions saved;
    saved.world = save.string();
    auto opened = TERRANE_TRY(
        io::openSessionParts(options, saved, store::WorldAccess::ReadWrite, store::WorldSharing::Servers));
    opened.parts.storesGenerated = false;
    auto records = TERRANE_TRY(net::SqliteRecords::open(file, *opened.parts.blocks));
    const auto host = TERRANE_TRY(net::openServerHost(std::move(opened.parts), std::move(records), {},
                                                      "backup", {.generators = opened.content.generators}));
    return net::saveEverything(*host.state);
}

}  // namespace

base::Result<void> writeBackup(const store::WorldLocation& world, const io::WorldOptions& options,
                               const std::filesystem::path& save, const store::CopyProgress& progress) {
    {
        const auto content =
            TERRANE_TRY(io::loadContent(options, {.world = world.text, .storeGenerated = {}}));
        if (world.kind == store::WorldLocation::Kind::Url) {
            TERRANE_TRY(net_postgres::copyDatabase(world, *content.blocks, save, progress));
        } else {
            const auto file = TERRANE_TRY(store::fileOf(world));
            TERRANE_TRY(copyFile(file, *content.blocks, save, progress));
        }
    }
    return addEndOfHistory(options, save);
}

}  // namespace terrane::app
