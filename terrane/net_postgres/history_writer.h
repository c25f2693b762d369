// Appends a server's writes to the records in PostgreSQL, each batch in one transaction, and reads what other
// servers appended. For the thread that writes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "terrane/net_postgres/history_order.h"
#include "terrane/net_postgres/shared_notes.h"
#include "terrane/store/block_id_map.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::net_postgres {

// An edit as a row.
struct EditToWrite {
    std::int64_t timeMs = 0, player = 0, chunk = 0;
    net::Bytes blocks;
};

struct QueuedWrite {
    std::uint64_t number = 0;
    // Edits of one command, and the blocks that they change: all of it is accepted or nothing.
    std::vector<EditToWrite> edits;
    std::vector<world::BlockPos> blocks;
    std::uint64_t basis = 0;  // HistoryOrder
    // Or anything else, with what the other servers are told of it.
    std::vector<store_postgres::Command> commands;
    std::optional<Note> note;
    // The commands add this player: where it is not there after them, another one has the name.
    struct Added {
        game::PlayerId id = game::kNoPlayer;
        net::PublicKey key{};
    };
    std::optional<Added> added = {};
};

// What the server is to hear.
struct HeardEvent {
    net::HistoryEvent event;
    std::uint64_t heard =
        0;  // its number (HistoryOrder); 0: it changes nothing that the server does not know
};
struct Heard {
    std::vector<HeardEvent> events;
    std::vector<game::PlayerId> refused;  // players
    bool isWritten = false;               // the batch that write() was given, now or before
};

class HistoryWriter {
  public:
    // All edits up to `seen` are known. The address and the ids outlive it.
    HistoryWriter(const store_postgres::Address& address, const store::BlockIdMap& ids, std::string channel,
                  std::int64_t server, std::int64_t seen)
        : address_(address), ids_(ids), channel_(std::move(channel)), server_(server), seen_(seen) {}

    // The edits that others appended since. Those of `heard` that were read before an error count.
    [[nodiscard]] base::Result<void> readOthers(store_postgres::Connection& connection, Heard& heard);
    // All of the batch, or nothing. Where it failed, the batch may be in the database all the same: it is
    // written again, before any other, unless readOthers() said meanwhile that it is there.
    [[nodiscard]] base::Result<void> write(store_postgres::Connection& connection,
                                           const std::vector<QueuedWrite>& batch, Heard& heard);

    // Gives a write up that the database will never take.
    void refuse(const QueuedWrite& write, Heard& heard);

    std::int64_t seen() const { return seen_; }
    std::int64_t newestOwn() const { return newestOwn_; }  // edit of this server; 0: none
    // No write with a lower basis will come.
    void forget(std::uint64_t basis) { order_.forget(basis); }

  private:
    // A batch on its way: it may be in the database although the connection broke.
    struct Attempt {
        std::vector<net::WriteDecision> decisions;
        std::vector<std::uint64_t> heard;  // of each decision
        std::vector<game::PlayerId> refused;
        std::int64_t newest = 0;  // of the history, with it
        bool hasEdits = false;    // that are accepted
    };
    base::Result<std::int64_t> lockHistory(store_postgres::Connection& connection);
    Attempt decide(const std::vector<QueuedWrite>& batch, std::int64_t newest);
    base::Result<void> send(store_postgres::Connection& connection, const std::vector<QueuedWrite>& batch,
                            Attempt& attempt);
    void readRow(const store_postgres::Rows& rows, int row, const std::string& shown, Heard& heard);
    void finish(const Attempt& attempt, Heard& heard);

    const store_postgres::Address& address_;
    const store::BlockIdMap& ids_;
    std::string channel_;
    std::int64_t server_, seen_, newestOwn_ = 0;
    HistoryOrder order_;
    std::optional<Attempt> unsure_;
};

// Tells all servers something, now.
store_postgres::Command notifyCommand(const std::string& channel, std::int64_t server, const Note& note);

}  // namespace terrane::net_postgres
