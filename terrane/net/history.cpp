#include "terrane/net/history.h"

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "terrane/net/people.h"
#include "terrane/net/sqlite_edits.h"
#include "terrane/store/schema.h"

namespace terrane::net {

base::Result<History> readHistoryFile(const std::filesystem::path& file, const world::BlockRegistry& blocks) {
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        return base::fail(base::ErrorCode::NotFound,
                          "{}: there is no such file: no server has run this world", file.string());
    auto database = TERRANE_TRY(store::Database::open(file, store::OpenMode::ReadOnly));
    const auto names = TERRANE_TRY(store::readBlockNames(database));
    auto ids = store::BlockIdMap::make(blocks, names);
    if (!ids) return tl::unexpected(ids.error());
    History history;
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        history.names[static_cast<game::PlayerId>(row.number(0))] = row.text(1);
        return {};
    };
    TERRANE_TRY(store::forEachRow(database, "SELECT id, name FROM players", take));
    const auto kept = std::make_shared<store::Database>(std::move(database));
    history.forEachEdit = [kept, ids = std::move(*ids)](const EditFilter& filter, EditOrder order,
                                                        const UseEdit& use) {
        return forEachEdit(*kept, ids, filter, order, use);
    };
    return history;
}

std::optional<game::PlayerId> playerCalled(const History& history, std::string_view name) {
    for (const auto& [id, known] : history.names)
        if (isSameName(known, name)) return id;
    return std::nullopt;
}

std::string nameOf(const History& history, game::PlayerId player) {
    if (player == game::kNoPlayer) return "the server";
    const auto found = history.names.find(player);
    return found == history.names.end() ? fmt::format("player {}", player) : found->second;
}

}  // namespace terrane::net
