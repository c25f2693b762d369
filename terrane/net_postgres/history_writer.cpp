#include "terrane/net_postgres/history_writer.h"

#include <algorithm>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store_postgres/world_locks.h"

namespace terrane::net_postgres {

std::uint64_t HistoryOrder::hear(std::span<const world::BlockPos> blocks) {
    ++heard_;
    for (const world::BlockPos pos : blocks) changedBy_[pos] = heard_;
    return heard_;
}

bool HistoryOrder::isAccepted(std::span<const world::BlockPos> blocks, std::uint64_t basis) const {
    return std::ranges::none_of(blocks, [&](world::BlockPos pos) {
        const auto found = changedBy_.find(pos);
        return found != changedBy_.end() && found->second > basis;
    });
}

void HistoryOrder::forget(std::uint64_t basis) {
    std::erase_if(changedBy_, [&](const auto& entry) { return entry.second <= basis; });
}

std::vector<world::BlockPos> blocksOf(const net::LoggedEdit& edit) {
    std::vector<world::BlockPos> blocks;
    blocks.reserve(edit.after.size());
    for (const net::ChangedBlock& block : edit.after)
        blocks.push_back(world::blockPos(edit.chunk, block.index));
    return blocks;
}

namespace {

using store_postgres::Command;
using store_postgres::Connection;
using store_postgres::Parameters;
using store_postgres::Rows;
using store_postgres::Statement;

constexpr std::int64_t kEditsAtOnce = 1000;

constexpr Statement kNewest = {"SELECT newest FROM history"};
constexpr Statement kOthers = {
    "SELECT number, time, player, chunk, server, blocks FROM edits WHERE number > $1 ORDER BY number LIMIT "
    "$2"};
constexpr Statement kAppend = {
    "INSERT INTO edits (number, time, player, chunk, write, blocks, server) SELECT *, $7 FROM "
    "unnest($1::bigint[], $2::bigint[], $3::bigint[], $4::bigint[], $5::bigint[], $6::bytea[])"};
constexpr Statement kSetNewest = {"UPDATE history SET newest = $1"};
constexpr Statement kHasPlayer = {"SELECT EXISTS (SELECT 1 FROM players WHERE id = $1 AND key = $2)"};
// Independent of the database's default: reads under the lock must see what others committed before.
constexpr const char* kBegin = "BEGIN ISOLATION LEVEL READ COMMITTED";
constexpr Statement kNotify = {"SELECT pg_notify($1, $2)"};

}  // namespace

Command notifyCommand(const std::string& channel, std::int64_t server, const Note& note) {
    return {&kNotify, Parameters().text(channel).text(noteText(server, note))};
}

// Own edits were reported when they were written, except those of a batch whose connection broke during
// COMMIT: a row of it proves that it was committed.
void HistoryWriter::readRow(const Rows& rows, int row, const std::string& shown, Heard& heard) {
    if (rows.number(row, 0) <= seen_) return;
    seen_ = rows.number(row, 0);
    if (rows.number(row, 4) == server_) {
        if (unsure_) finish(*std::exchange(unsure_, std::nullopt), heard);
        return;
    }
    auto edit = net::decodeEdit({rows.number(row, 0), rows.number(row, 1), rows.number(row, 2),
                                 rows.number(row, 3), rows.bytes(row, 5)},
                                ids_);
    if (!edit) return base::logError("{}: {}", shown, edit.error().message);
    const std::uint64_t number = order_.hear(blocksOf(*edit));
    heard.events.push_back({std::move(*edit), number});
}

base::Result<void> HistoryWriter::readOthers(Connection& connection, Heard& heard) {
    while (true) {
        const auto rows =
            TERRANE_TRY(connection.run(kOthers, Parameters().number(seen_).number(kEditsAtOnce)));
        for (int row = 0; row < rows.count(); ++row) readRow(rows, row, connection.shown(), heard);
        if (rows.count() < kEditsAtOnce) return {};
    }
}

base::Result<std::int64_t> HistoryWriter::lockHistory(Connection& connection) {
    TERRANE_TRY(store_postgres::lockForTransaction(connection, address_, store_postgres::WorldLock::History));
    const auto newest = TERRANE_TRY(connection.run(kNewest));
    return newest.number(0, 0);
}

HistoryWriter::Attempt HistoryWriter::decide(const std::vector<QueuedWrite>& batch, std::int64_t newest) {
    Attempt attempt;
    attempt.newest = newest;
    for (const QueuedWrite& write : batch) {
        if (write.edits.empty()) continue;
        const bool isAccepted = order_.isAccepted(write.blocks, write.basis);
        attempt.decisions.push_back({write.number, isAccepted, attempt.newest + 1});
        // Edits on top of a refused one are refused, too.
        attempt.heard.push_back(isAccepted ? 0 : order_.hear(write.blocks));
        if (!isAccepted) continue;
        attempt.newest += static_cast<std::int64_t>(write.edits.size());
        attempt.hasEdits = true;
    }
    return attempt;
}

base::Result<void> HistoryWriter::send(Connection& connection, const std::vector<QueuedWrite>& batch,
                                       Attempt& attempt) {
    std::vector<std::int64_t> numbers, times, players, chunks, writes;
    std::vector<store::Bytes> blocks;
    std::vector<Command> commands;
    std::vector<std::pair<std::size_t, game::PlayerId>> added;  // index of the checking command, player
    auto decision = attempt.decisions.begin();
    for (const QueuedWrite& write : batch) {
        commands.insert(commands.end(), write.commands.begin(), write.commands.end());
        if (write.added) {
            added.push_back({commands.size(), write.added->id});
            commands.push_back(
                {&kHasPlayer, Parameters().number(std::int64_t{write.added->id}).bytes(write.added->key)});
        }
        if (write.note) commands.push_back(notifyCommand(channel_, server_, *write.note));
        if (write.edits.empty()) continue;
        const net::WriteDecision& decided = *decision++;
        if (!decided.isAccepted) continue;
        for (const EditToWrite& edit : write.edits) {
            numbers.push_back(decided.firstNumber + static_cast<std::int64_t>(&edit - write.edits.data()));
            times.push_back(edit.timeMs);
            players.push_back(edit.player);
            chunks.push_back(edit.chunk);
            writes.push_back(static_cast<std::int64_t>(write.number));
            blocks.push_back(edit.blocks);
        }
    }
    if (!numbers.empty()) {
        commands.push_back({&kAppend, Parameters()
                                          .numbers(numbers)
                                          .numbers(times)
                                          .numbers(players)
                                          .numbers(chunks)
                                          .numbers(writes)
                                          .byteStrings(blocks)
                                          .number(server_)});
        commands.push_back({&kSetNewest, Parameters().number(attempt.newest)});
        commands.push_back(notifyCommand(channel_, server_, EditsNote{}));
    }
    if (commands.empty()) return {};
    const auto rows = TERRANE_TRY(connection.runAll(commands));
    for (const auto& [command, player] : added)
        if (rows[command].number(0, 0) == 0) attempt.refused.push_back(player);
    return {};
}

void HistoryWriter::finish(const Attempt& attempt, Heard& heard) {
    for (std::size_t k = 0; k < attempt.decisions.size(); ++k)
        heard.events.push_back({attempt.decisions[k], attempt.heard[k]});
    heard.refused.insert(heard.refused.end(), attempt.refused.begin(), attempt.refused.end());
    seen_ = std::max(seen_, attempt.newest);
    if (attempt.hasEdits) newestOwn_ = attempt.newest;
    heard.isWritten = true;
}

void HistoryWriter::refuse(const QueuedWrite& write, Heard& heard) {
    if (!write.edits.empty())
        heard.events.push_back({net::WriteDecision{write.number, false, 0}, order_.hear(write.blocks)});
    heard.isWritten = true;
}

// An earlier transaction that was cut off and still runs holds the lock until it ends.
base::Result<void> HistoryWriter::write(Connection& connection, const std::vector<QueuedWrite>& batch,
                                        Heard& heard) {
    TERRANE_TRY(connection.execute(kBegin));
    const auto newest = lockHistory(connection);
    auto done = newest ? readOthers(connection, heard) : tl::unexpected(newest.error());
    if (done && !heard.isWritten) {
        unsure_.reset();
        Attempt attempt = decide(batch, *newest);
        done = send(connection, batch, attempt);
        if (done) {
            unsure_ = std::move(attempt);
            done = connection.execute("COMMIT");
            if (done) finish(*std::exchange(unsure_, std::nullopt), heard);
            return done;
        }
    }
    if (connection.isUsable()) (void)connection.execute("ROLLBACK");
    return done;
}

}  // namespace terrane::net_postgres
