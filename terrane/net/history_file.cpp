#include "terrane/net/history_file.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "terrane/net/sqlite_edits.h"
#include "terrane/store/schema.h"

namespace terrane::net {

base::Result<HistoryFile> HistoryFile::open(const std::filesystem::path& file,
                                            const world::BlockRegistry& blocks) {
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        return base::fail(base::ErrorCode::NotFound, "{}: there is no such file: no server had this world",
                          file.string());
    auto database = store::Database::open(file, store::OpenMode::ReadOnly);
    if (!database) return tl::unexpected(database.error());
    const auto names = store::readBlockNames(*database);
    if (!names) return tl::unexpected(names.error());
    auto ids = store::BlockIdMap::make(blocks, *names);
    if (!ids) return tl::unexpected(ids.error());
    HistoryFile history(std::move(*database), std::move(*ids));
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        history.names_[static_cast<game::PlayerId>(row.number(0))] = row.text(1);
        return {};
    };
    if (auto done = store::forEachRow(history.database_, "SELECT id, name FROM players", take); !done)
        return tl::unexpected(done.error());
    return history;
}

std::optional<game::PlayerId> HistoryFile::playerCalled(std::string_view name) const {
    const auto isEqual = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    for (const auto& [id, known] : names_)
        if (std::ranges::equal(known, name, isEqual)) return id;
    return std::nullopt;
}

std::string HistoryFile::nameOf(game::PlayerId player) const {
    if (player == game::kNoPlayer) return "the server";
    const auto found = names_.find(player);
    return found == names_.end() ? fmt::format("player {}", player) : found->second;
}

base::Result<void> HistoryFile::forEach(const EditFilter& filter, const UseEdit& use) {
    return forEachEdit(database_, ids_, filter, EditOrder::NewestFirst, use);
}

}  // namespace terrane::net
