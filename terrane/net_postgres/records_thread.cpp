// The thread of PostgresRecords: commits queued writes, listens to other servers, sends heartbeats.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/base/timing.h"
#include "terrane/net_postgres/postgres_records.h"
#include "terrane/net_postgres/record_rows.h"

namespace terrane::net_postgres {
namespace {

using store_postgres::Command;
using store_postgres::Connection;

// Notifications arrive at once. Missed ones are made up for by queries: edits each second, all else after a
// broken connection.
constexpr std::chrono::milliseconds kLookEvery{1000}, kBeatEvery{1000}, kTryAgain{200};
constexpr std::size_t kMaxBatch = 4096;
constexpr std::size_t kNotesAtOnce = 256;
// A lease is used for less time than it lasts, since it began when the database granted it.
constexpr std::chrono::seconds kLeaseUsed{kGoneSeconds - 2};
constexpr std::size_t kPlayerNumbers = 64;
// Limit for writing the queue at the end if the database does not answer.
constexpr std::chrono::seconds kLastAttempts{10};

}  // namespace

void PostgresRecords::run() {
    base::setThreadName("records");
    std::optional<Clock::time_point> endBy;
    base::FailureReport report(base::kQuietAfterFailure);
    while (true) {
        waitForWork();
        const auto done = work();
        std::unique_lock lock(mutex_);
        ++attempts_;
        if (!done && report.hasBegun()) base::logError("{}", done.error().message);
        if (done && report.hasEnded(Clock::now())) base::logInfo("{}: it works again", name_.name);
        problem_ = done ? "" : done.error().message;
        written_.notify_all();
        const bool isEmpty = queue_.empty() && batch_.empty();
        if (isEnding_ && !endBy) endBy = Clock::now() + kLastAttempts;
        if (isEnding_ && (isEmpty || Clock::now() > *endBy)) break;
        lock.unlock();
        if (!done) std::this_thread::sleep_for(kTryAgain);
    }
    // A server with unsaved edits stays in the list: others save its chunks.
    const bool hasSaved = state_.saved >= writer_->newestOwn();
    if (hasSaved && connection_ && connection_->isUsable())
        (void)removeServer(*connection_, server_, state_.saved);
}

void PostgresRecords::waitForWork() {
    const Clock::time_point next = std::min(nextLook_, nextBeat_);
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(next - Clock::now()).count() + 1;
    pollfd sockets[] = {{wakeSocket_, POLLIN, 0}, {connection_ ? connection_->socket() : -1, POLLIN, 0}};
    {
        const std::lock_guard lock(mutex_);
        if (isEnding_ || !queue_.empty() || !notes_.empty()) return;
    }
    // Notifications that arrived with a result do not wake poll().
    if (connection_) keepNotices();
    if (batch_.empty() && notices_.empty() && left > 0)
        ::poll(sockets, std::size(sockets), static_cast<int>(left));
    std::uint64_t count = 0;
    (void)!::read(wakeSocket_, &count, sizeof count);
}

base::Result<void> PostgresRecords::work() {
    TERRANE_TRY(connect());
    Heard heard;
    auto done = takeNotes(heard);
    if (done) done = writeQueued(heard);
    hand(std::move(heard));  // also events before an error
    if (!done) return done;
    TERRANE_TRY(reservePlayerNumbers());
    TERRANE_TRY(sendNotes());
    return beatIfDue();
}

// Takes the locks of a server: until it ends, programs that play alone or regenerate the world get Busy.
base::Result<void> PostgresRecords::connect() {
    if (!connection_ || !connection_->isUsable()) {
        auto connection =
            TERRANE_TRY(store_postgres::reconnect(pool_.address(), store::WorldSharing::Servers, contents_));
        connection_ = std::move(connection);
        nextLook_ = nextBeat_ = {};
        mustLookUp_ = true;
        TERRANE_TRY(listen());
    }
    return mustLookUp_ ? lookUp() : base::Result<void>();
}

// Reads all players, claims, places, the password, and who plays elsewhere, since notes may have been missed.
// Changes queued here are newer: their own notes report them again.
base::Result<void> PostgresRecords::lookUp() {
    auto players = TERRANE_TRY(readPlayers(*connection_));
    auto claims = TERRANE_TRY(readClaims(*connection_));
    auto hash = TERRANE_TRY(readText(*connection_, net::kPasswordText));
    auto places = TERRANE_TRY(readPlaces(*connection_));
    auto elsewhere = TERRANE_TRY(readElsewhere(*connection_, server_));
    mustLookUp_ = false;
    const std::lock_guard lock(mutex_);
    std::move(players.begin(), players.end(), std::back_inserter(news_.players));
    news_.claims = std::move(claims);
    news_.passwordHash = std::move(hash);
    news_.allPlaces = std::move(places);
    news_.places.clear();  // older than allPlaces
    for (const game::PlayerId player : elsewhere)
        if (!joinsHere(player)) news_.joined.push_back(player);
    return {};
}

// Whether the player joined here last, and this is not committed yet.
bool PostgresRecords::joinsHere(game::PlayerId player) const {
    const auto isJoin = [&](const QueuedWrite& write) {
        const auto* joined = write.note ? std::get_if<JoinedNote>(&*write.note) : nullptr;
        return joined && joined->player == player;
    };
    return std::ranges::any_of(batch_, isJoin) || std::ranges::any_of(queue_, isJoin);
}

base::Result<void> PostgresRecords::listen() {
    return connection_->execute("LISTEN " + connection_->quoted(channel_));
}

void PostgresRecords::keepNotices() {
    for (store_postgres::Notification& notice : connection_->notifications())
        notices_.push_back(std::move(notice));
}

base::Result<void> PostgresRecords::takeNotes(Heard& heard) {
    keepNotices();
    bool hasEdits = Clock::now() >= nextLook_;
    for (const store_postgres::Notification& notice : std::exchange(notices_, {})) {
        const auto read = readNote(notice.payload);
        // Own notes about rows are read as well: an own change may be newer than one heard from another
        // server.
        if (!read || (read->server == server_ && !isOfRows(read->note))) continue;
        if (auto taken = takeNote(read->note, hasEdits); !taken) {
            mustLookUp_ = true;
            return taken;
        }
    }
    if (!hasEdits) return {};
    nextLook_ = Clock::now() + kLookEvery;
    return writer_->readOthers(*connection_, heard);
}

base::Result<void> PostgresRecords::takeNote(const Note& note, bool& hasEdits) {
    if (std::holds_alternative<EditsNote>(note)) hasEdits = true;
    if (const auto* changed = std::get_if<PlayerNote>(&note)) {
        auto player = TERRANE_TRY(readPlayer(*connection_, changed->player));
        const std::lock_guard lock(mutex_);
        if (player) news_.players.push_back(std::move(*player));
    }
    if (std::holds_alternative<PasswordNote>(note)) {
        auto hash = TERRANE_TRY(readText(*connection_, net::kPasswordText));
        const std::lock_guard lock(mutex_);
        news_.passwordHash = std::move(hash);
    }
    if (std::holds_alternative<ClaimsNote>(note)) {
        auto claims = TERRANE_TRY(readClaims(*connection_));
        const std::lock_guard lock(mutex_);
        news_.claims = std::move(claims);
    }
    if (const auto* joined = std::get_if<JoinedNote>(&note)) {
        // The player may have joined here since.
        const auto server = TERRANE_TRY(readServerOf(*connection_, joined->player));
        const std::lock_guard lock(mutex_);
        if (server != server_ && !joinsHere(joined->player)) news_.joined.push_back(joined->player);
    }
    const std::lock_guard lock(mutex_);
    if (const auto* left = std::get_if<LeftNote>(&note)) news_.left.push_back(left->player);
    if (const auto* time = std::get_if<TimeNote>(&note)) news_.timeDay = time->timeDay / kTimeSteps;
    if (const auto* place = std::get_if<PlaceNote>(&note)) news_.places.push_back(place->change);
    if (const auto* line = std::get_if<LineNote>(&note)) news_.lines.push_back(line->line);
    if (const auto* poses = std::get_if<PosesNote>(&note))
        news_.poses.insert(news_.poses.end(), poses->players.begin(), poses->players.end());
    if (const auto* tiles = std::get_if<TilesNote>(&note))
        news_.tiles.insert(news_.tiles.end(), tiles->tiles.begin(), tiles->tiles.end());
    return {};
}

// A failed batch is written again unchanged before anything else.
base::Result<void> PostgresRecords::writeQueued(Heard& heard) {
    if (heard.isWritten) return {};
    if (batch_.empty()) {
        const std::lock_guard lock(mutex_);
        const std::size_t count = std::min(queue_.size(), oneByOne_ > 0 ? 1 : kMaxBatch);
        if (oneByOne_ > 0) --oneByOne_;
        std::move(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(count),
                  std::back_inserter(batch_));
        queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(count));
    }
    if (batch_.empty()) return {};
    auto done = writer_->write(*connection_, batch_, heard);
    if (done || done.error().code != base::ErrorCode::Failed) return done;
    // The database rejects the batch: find the rejected write by trying one at a time, and refuse it.
    base::logError("{}; {}", done.error().message,
                   batch_.size() > 1 ? "it is tried one by one" : "it is given up");
    if (batch_.size() == 1) {
        writer_->refuse(batch_.front(), heard);
        return {};
    }
    const std::lock_guard lock(mutex_);
    oneByOne_ = batch_.size();
    std::move(batch_.begin(), batch_.end(), std::inserter(queue_, queue_.begin()));
    batch_.clear();
    return {};
}

// Passes all events to the server's thread at once.
void PostgresRecords::hand(Heard heard) {
    const std::lock_guard lock(mutex_);
    for (HeardEvent& event : heard.events) {
        const auto* decision = std::get_if<net::WriteDecision>(&event.event);
        if (decision) committed_ = std::max(committed_, decision->write);
        heard_ = std::max(heard_, event.heard);
        news_.history.push_back(std::move(event.event));
    }
    news_.refused.insert(news_.refused.end(), heard.refused.begin(), heard.refused.end());
    news_.newest = writer_->seen();
    if (heard.isWritten && !batch_.empty()) {
        committed_ = std::max(committed_, batch_.back().number);
        batch_.clear();
    }
    // Queued writes have at least this basis.
    const std::uint64_t basis = queue_.empty() ? basis_ : std::min(basis_, queue_.front().basis);
    if (batch_.empty()) writer_->forget(basis);
}

base::Result<void> PostgresRecords::sendNotes() {
    std::vector<Command> commands;
    {
        const std::lock_guard lock(mutex_);
        for (const Note& note : notes_) {
            if (commands.size() == kNotesAtOnce) break;
            commands.push_back(notifyCommand(channel_, server_, note));
        }
    }
    if (commands.empty()) return {};
    TERRANE_TRY(connection_->changeAll(commands));
    const std::lock_guard lock(mutex_);
    notes_.erase(notes_.begin(), notes_.begin() + static_cast<std::ptrdiff_t>(commands.size()));
    return {};
}

base::Result<void> PostgresRecords::beatIfDue() {
    const Clock::time_point now = Clock::now();
    if (now < nextBeat_) return {};
    ServerBeat state;
    ServerName name;
    {
        const std::lock_guard lock(mutex_);
        state = state_;
        name = name_;
        state.regions = {requestedRegions_.begin(), requestedRegions_.end()};
    }
    auto answer = TERRANE_TRY(beat(*connection_, name, state));
    nextBeat_ = now + kBeatEvery;
    TERRANE_TRY(findUnsaved(answer.others));
    const std::lock_guard lock(mutex_);
    news_.saved = std::max(news_.saved, answer.saved);
    news_.servers = std::move(answer.others);
    leased_ = {answer.regions.begin(), answer.regions.end()};
    leasedUntil_ = now + kLeaseUsed;
    return {};
}

// Queries the unsaved chunks of each stopped server once. The server's thread may learn of them later.
base::Result<void> PostgresRecords::findUnsaved(std::vector<net::OtherServer>& others) {
    std::erase_if(gone_, [&](const auto& entry) {
        return std::ranges::none_of(others, [&](const auto& other) { return other.number == entry.first; });
    });
    for (net::OtherServer& other : others) {
        if (other.isAlive) {
            gone_.erase(other.number);
            continue;
        }
        const auto [known, isNew] = gone_.try_emplace(other.number);
        if (isNew) {
            auto chunks = unsavedChunks(*connection_, other.number);
            if (!chunks) gone_.erase(known);
            if (!chunks) return tl::unexpected(chunks.error());
            known->second = std::move(*chunks);
        }
        other.unsaved = known->second;
    }
    return {};
}

base::Result<void> PostgresRecords::reservePlayerNumbers() {
    {
        const std::lock_guard lock(mutex_);
        if (numbers_.size() >= kPlayerNumbers / 2) return {};
    }
    auto numbers = TERRANE_TRY(allocatePlayerIds(*connection_, kPlayerNumbers));
    const std::lock_guard lock(mutex_);
    // Numbers are taken from the back, the lowest first.
    numbers_.insert(numbers_.begin(), numbers.rbegin(), numbers.rend());
    return {};
}

}  // namespace terrane::net_postgres
