// Appends a server's writes to the records in PostgreSQL, one transaction per batch, and reads edits appended
// by other servers. For the thread that writes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/net/server/edit_log.h"
#include "terrane/net_postgres/shared_notes.h"
#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::net_postgres {

// Conflict detection: decides which edits of a server are accepted, from the events that it had received
// before. A plain class, for the thread that writes the history.
//
// Events that a server receives (edits of others, refusals of its own) are numbered in this order. The basis
// of an own edit is the number of the last event received before it. The edit is refused if an event after
// its basis changed one of its blocks.
class HistoryOrder {
  public:
    // Adds the next event, which changes these blocks. Returns its number.
    std::uint64_t hear(std::span<const world::BlockPos> blocks);
    std::uint64_t heard() const { return heard_; }

    bool isAccepted(std::span<const world::BlockPos> blocks, std::uint64_t basis) const;

    // Drops events up to `basis`: no edit with a lower basis will follow.
    void forget(std::uint64_t basis);
    std::size_t size() const { return changedBy_.size(); }

  private:
    std::uint64_t heard_ = 0;
    // Number of the last event that changed each block.
    std::unordered_map<world::BlockPos, std::uint64_t, world::BlockPosHash> changedBy_;
};

std::vector<world::BlockPos> blocksOf(const net::LoggedEdit& edit);

// A row of the table `edits`.
struct EditToWrite {
    std::int64_t timeMs = 0, player = 0, chunk = 0;
    net::Bytes blocks;
};

struct QueuedWrite {
    std::uint64_t number = 0;
    // Edits of one command and the blocks that they change; accepted or refused as a whole.
    std::vector<EditToWrite> edits;
    std::vector<world::BlockPos> blocks;
    std::uint64_t basis = 0;  // HistoryOrder
    // Alternatively other commands, and a note for the other servers.
    std::vector<store_postgres::Command> commands;
    std::optional<Note> note;
    // The player added by the commands; if it is missing afterwards, another player has the name.
    struct Added {
        game::PlayerId id = game::kNoPlayer;
        net::PublicKey key{};
    };
    std::optional<Added> added = {};
};

// An event for the server.
struct HeardEvent {
    net::HistoryEvent event;
    // Event number (HistoryOrder); 0 if the server already has the change.
    std::uint64_t heard = 0;
};
struct Heard {
    std::vector<HeardEvent> events;
    std::vector<game::PlayerId> refused;  // added players whose names were taken
    bool isWritten = false;               // the batch of write() is committed
};

class HistoryWriter {
  public:
    // All edits up to `seen` are known. `address` and `ids` outlive this.
    HistoryWriter(const store_postgres::Address& address, const store::BlockIdMap& ids, std::string channel,
                  std::int64_t server, std::int64_t seen)
        : address_(address), ids_(ids), channel_(std::move(channel)), server_(server), seen_(seen) {}

    // Reads edits that others appended since the last call. After an error, the edits in `heard` are valid.
    [[nodiscard]] base::Result<void> readOthers(store_postgres::Connection& connection, Heard& heard);
    // Writes all of the batch or nothing. After an error, the batch may have been committed: call again with
    // the same batch, unless readOthers() set `heard.isWritten` meanwhile.
    [[nodiscard]] base::Result<void> write(store_postgres::Connection& connection,
                                           const std::vector<QueuedWrite>& batch, Heard& heard);

    // Refuses a write that the database rejects permanently.
    void refuse(const QueuedWrite& write, Heard& heard);

    std::int64_t seen() const { return seen_; }
    std::int64_t newestOwn() const { return newestOwn_; }  // newest edit of this server; 0: none
    // No write with a lower basis will follow.
    void forget(std::uint64_t basis) { order_.forget(basis); }

  private:
    // A batch in transit: it may be committed although the connection broke.
    struct Attempt {
        std::vector<net::WriteDecision> decisions;
        std::vector<std::uint64_t> heard;  // event number of each decision
        std::vector<game::PlayerId> refused;
        std::int64_t newest = 0;  // newest edit of the history, including the batch
        bool hasEdits = false;    // any accepted edits
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

// A command that sends a note to all servers.
store_postgres::Command notifyCommand(const std::string& channel, std::int64_t server, const Note& note);

}  // namespace terrane::net_postgres
