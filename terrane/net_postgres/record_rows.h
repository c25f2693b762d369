// Players, claims, texts and edits of a world's servers as rows in PostgreSQL: functions that read them
// through a connection, and commands that write them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "terrane/game/places.h"
#include "terrane/net/server/server_records.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::net_postgres {

[[nodiscard]] base::Result<std::vector<net::KnownPlayer>> readPlayers(store_postgres::Connection& connection);
[[nodiscard]] base::Result<std::optional<net::KnownPlayer>> readPlayer(store_postgres::Connection& connection,
                                                                       game::PlayerId id);
[[nodiscard]] base::Result<std::vector<game::Claim>> readClaims(store_postgres::Connection& connection);
[[nodiscard]] base::Result<std::string> readText(store_postgres::Connection& connection,
                                                 const std::string& name);
// Named places, which are metadata written by the store.
[[nodiscard]] base::Result<std::vector<game::Place>> readPlaces(store_postgres::Connection& connection);
[[nodiscard]] base::Result<net::HistoryEnds> readEnds(store_postgres::Connection& connection);
// Players who are on other servers than this one.
[[nodiscard]] base::Result<std::vector<game::PlayerId>> readElsewhere(store_postgres::Connection& connection,
                                                                      std::int64_t server);
// The server that the player joined last; no value if the player is on none.
[[nodiscard]] base::Result<std::optional<std::int64_t>> readServerOf(store_postgres::Connection& connection,
                                                                     game::PlayerId player);
// A page of the history, to bound the memory.
struct EditPage {
    std::vector<net::LoggedEdit> edits;  // edits that match the filter
    std::optional<std::int64_t> last;    // number of the last edit examined; none at the end
};
// Reads the edits after `last`, or the first ones.
[[nodiscard]] base::Result<EditPage> readEdits(store_postgres::Connection& connection,
                                               const store::BlockIdMap& ids, const net::EditFilter& filter,
                                               net::EditOrder order, std::optional<std::int64_t> last);
// See net::ServerRecords::forEachEdit(). A page that is read again after a broken connection is used once.
using ReadEditPage = std::function<base::Result<EditPage>(std::optional<std::int64_t> last)>;
[[nodiscard]] base::Result<void> forEachEdit(const ReadEditPage& read, const net::UseEdit& use);

// Inserts nothing if another player has the key or the name.
store_postgres::Command addPlayerCommand(const net::KnownPlayer& player);
// Keeps the old name if another player has the new one.
store_postgres::Command changePlayerCommand(game::PlayerId id, const net::PlayerChange& change);
store_postgres::Command addClaimCommand(const game::Claim& claim);
store_postgres::Command removeClaimCommand(const std::string& name);
store_postgres::Command setTextCommand(const std::string& name, const std::string& text);
store_postgres::Command joinedCommand(game::PlayerId player, std::int64_t server);
store_postgres::Command leftCommand(game::PlayerId player, std::int64_t server);
store_postgres::Command setSavedCommand(std::int64_t number);
// New players get numbers above this one.
store_postgres::Command skipPlayerNumberCommand(game::PlayerId player);

[[nodiscard]] base::Result<std::vector<game::PlayerId>> allocatePlayerIds(
    store_postgres::Connection& connection, std::size_t count);

}  // namespace terrane::net_postgres
