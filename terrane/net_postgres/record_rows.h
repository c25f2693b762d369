// Players, claims, texts and edits of a world's servers as rows in PostgreSQL: reading by a connection, and
// commands that write them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "terrane/game/places.h"
#include "terrane/net/server_records.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::net_postgres {

[[nodiscard]] base::Result<std::vector<net::KnownPlayer>> readPlayers(store_postgres::Connection& connection);
[[nodiscard]] base::Result<std::optional<net::KnownPlayer>> readPlayer(store_postgres::Connection& connection,
                                                                       game::PlayerId id);
[[nodiscard]] base::Result<std::vector<game::Claim>> readClaims(store_postgres::Connection& connection);
[[nodiscard]] base::Result<std::string> readText(store_postgres::Connection& connection,
                                                 const std::string& name);
// Names of places, which the store writes.
[[nodiscard]] base::Result<std::vector<game::Place>> readPlaces(store_postgres::Connection& connection);
[[nodiscard]] base::Result<net::HistoryEnds> readEnds(store_postgres::Connection& connection);
// Players who are on other servers than this one.
[[nodiscard]] base::Result<std::vector<game::PlayerId>> readElsewhere(store_postgres::Connection& connection,
                                                                      std::int64_t server);
// A part of the history, so that a long one takes no more memory than a short one.
struct EditPage {
    std::vector<net::LoggedEdit> edits;  // that the filter means
    std::optional<std::int64_t> last;    // the number of the last one that was looked at; none at the end
};
// The edits behind `last`, or the first ones.
[[nodiscard]] base::Result<EditPage> readEdits(store_postgres::Connection& connection,
                                               const store::BlockIdMap& ids, const net::EditFilter& filter,
                                               net::EditOrder order, std::optional<std::int64_t> last);
// As net::ServerRecords::forEachEdit(). A page that is read again where the connection broke is used once.
using ReadEditPage = std::function<base::Result<EditPage>(std::optional<std::int64_t> last)>;
[[nodiscard]] base::Result<void> forEachEdit(const ReadEditPage& read, const net::UseEdit& use);

// Inserts nothing where another player has the key or the name.
store_postgres::Command addPlayerCommand(const net::KnownPlayer& player);
// A name that another player has stays as it was.
store_postgres::Command changePlayerCommand(game::PlayerId id, const net::PlayerChange& change);
store_postgres::Command addClaimCommand(const game::Claim& claim);
store_postgres::Command removeClaimCommand(const std::string& name);
store_postgres::Command setTextCommand(const std::string& name, const std::string& text);
store_postgres::Command joinedCommand(game::PlayerId player, std::int64_t server);
store_postgres::Command leftCommand(game::PlayerId player, std::int64_t server);
store_postgres::Command setSavedCommand(std::int64_t number);
// Numbers of players go on above this one.
store_postgres::Command skipPlayerNumberCommand(game::PlayerId player);

[[nodiscard]] base::Result<std::vector<game::PlayerId>> takePlayerNumbers(
    store_postgres::Connection& connection, std::size_t count);

}  // namespace terrane::net_postgres
