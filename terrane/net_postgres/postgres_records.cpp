// Functions called by the server's thread; records_thread.cpp has those of the other thread.
#include "terrane/net_postgres/postgres_records.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "terrane/base/digest.h"
#include "terrane/net_postgres/record_rows.h"
#include "terrane/store/chunks/chunk_key.h"

namespace terrane::net_postgres {
namespace {

using store_postgres::Connection;
using store_postgres::Parameters;

// Maximum number of unsent notes. More are dropped, as while the database is unreachable for long: then chat
// lines, times and tiles are lost. Poses are sent again, and not queued while the database is unreachable.
constexpr std::size_t kMaxNotes = 4096;

}  // namespace

base::Result<net::History> readHistory(const store_postgres::Address& address,
                                       const world::BlockRegistry& blocks) {
    auto world = TERRANE_TRY(store_postgres::openToRead(address, blocks));
    const auto players = TERRANE_TRY(readPlayers(world.connection));
    net::History history;
    for (const net::KnownPlayer& player : players) history.names[player.id] = player.name;
    const auto kept = std::make_shared<store_postgres::WorldConnection>(std::move(world));
    history.forEachEdit = [kept](const net::EditFilter& filter, net::EditOrder order,
                                 const net::UseEdit& use) {
        return net_postgres::forEachEdit(
            [&](std::optional<std::int64_t> last) {
                return readEdits(kept->connection, kept->contents.ids, filter, order, last);
            },
            use);
    };
    return history;
}

base::Result<std::unique_ptr<PostgresRecords>> PostgresRecords::openToRead(
    const store_postgres::Address& address, const world::BlockRegistry& blocks, const ServerName& name) {
    auto world = TERRANE_TRY(store_postgres::openToRead(address, blocks));
    std::unique_ptr<PostgresRecords> records(new PostgresRecords(address, std::move(world.contents), name));
    records->connection_ = std::move(world.connection);
    return records;
}

base::Result<std::unique_ptr<PostgresRecords>> PostgresRecords::open(const store_postgres::Address& address,
                                                                     const world::BlockRegistry& blocks,
                                                                     const ServerName& name) {
    auto opened = TERRANE_TRY(openToRead(address, blocks, name));
    std::unique_ptr<PostgresRecords> records = std::move(opened);
    TERRANE_TRY(records->listen());
    const auto server = addServer(*records->connection_, name);
    if (!server) return tl::unexpected(server.error());
    const auto openings = TERRANE_TRY(store_postgres::readOpenings(*records->connection_));
    records->contents_.openings = openings;
    const auto ends = TERRANE_TRY(records->historyEnds());
    records->server_ = *server;
    records->state_ = {*server, ends.newest, 0, {}};
    records->news_.newest = ends.newest;
    records->news_.saved = ends.saved;
    records->writer_ = std::make_unique<HistoryWriter>(records->pool_.address(), records->contents_.ids,
                                                       records->channel_, *server, ends.newest);
    records->thread_ = std::thread([self = records.get()] { self->run(); });
    return records;
}

PostgresRecords::PostgresRecords(const store_postgres::Address& address,
                                 store_postgres::WorldContents contents, ServerName name)
    : pool_(address),
      contents_(std::move(contents)),
      name_(std::move(name)),
      channel_(fmt::format("terrane_{:016x}", base::hash64(address.schema))),
      wakeSocket_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

PostgresRecords::~PostgresRecords() {
    {
        const std::lock_guard lock(mutex_);
        isEnding_ = true;
    }
    wake();
    if (thread_.joinable()) thread_.join();
    ::close(wakeSocket_);
}

void PostgresRecords::wake() {
    const std::uint64_t one = 1;
    (void)!::write(wakeSocket_, &one, sizeof one);
}

std::uint64_t PostgresRecords::queue(QueuedWrite write) {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock(mutex_);
        number = write.number = ++queued_;
        write.basis = basis_;
        queue_.push_back(std::move(write));
    }
    wake();
    return number;
}

void PostgresRecords::tell(const Note& note) {
    {
        const std::lock_guard lock(mutex_);
        const bool isOld = !problem_.empty() && std::holds_alternative<PosesNote>(note);
        if (isOld || notes_.size() >= kMaxNotes) return;
        notes_.push_back(note);
    }
    wake();
}

base::Result<std::vector<net::KnownPlayer>> PostgresRecords::players() {
    return pool_.run<std::vector<net::KnownPlayer>>([](Connection& c) { return readPlayers(c); });
}
base::Result<std::vector<game::Claim>> PostgresRecords::claims() {
    return pool_.run<std::vector<game::Claim>>([](Connection& c) { return readClaims(c); });
}
base::Result<std::string> PostgresRecords::text(const std::string& name) {
    return pool_.run<std::string>([&](Connection& c) { return readText(c, name); });
}
base::Result<net::HistoryEnds> PostgresRecords::historyEnds() {
    return pool_.run<net::HistoryEnds>([](Connection& c) { return readEnds(c); });
}
base::Result<void> PostgresRecords::forEachEdit(const net::EditFilter& filter, net::EditOrder order,
                                                const net::UseEdit& use) {
    return net_postgres::forEachEdit(
        [&](std::optional<std::int64_t> last) {
            return pool_.run<EditPage>(
                [&](Connection& c) { return readEdits(c, contents_.ids, filter, order, last); });
        },
        use);
}

void PostgresRecords::addPlayer(const net::KnownPlayer& player) {
    QueuedWrite write;
    write.commands.push_back(addPlayerCommand(player));
    write.commands.push_back(skipPlayerNumberCommand(player.id));
    write.note = PlayerNote{player.id};
    write.added = {player.id, player.key};
    queue(std::move(write));
}
void PostgresRecords::changePlayer(game::PlayerId id, const net::PlayerChange& change) {
    QueuedWrite write;
    write.commands.push_back(changePlayerCommand(id, change));
    write.note = PlayerNote{id};
    queue(std::move(write));
}
void PostgresRecords::addClaim(const game::Claim& claim) {
    QueuedWrite write;
    write.commands.push_back(addClaimCommand(claim));
    write.note = ClaimsNote{};
    queue(std::move(write));
}
void PostgresRecords::removeClaim(const std::string& name) {
    QueuedWrite write;
    write.commands.push_back(removeClaimCommand(name));
    write.note = ClaimsNote{};
    queue(std::move(write));
}
void PostgresRecords::setText(const std::string& name, const std::string& text) {
    QueuedWrite write;
    write.commands.push_back(setTextCommand(name, text));
    if (name == net::kPasswordText) write.note = PasswordNote{};
    queue(std::move(write));
}

std::uint64_t PostgresRecords::append(const std::vector<net::LoggedEdit>& edits) {
    QueuedWrite write;
    for (const net::LoggedEdit& edit : edits) {
        write.edits.push_back({edit.timeMs, net::authorNumber(edit), store::keyOf(edit.chunk),
                               net::encodeEdit(edit, contents_.ids)});
        const std::vector<world::BlockPos> blocks = blocksOf(edit);
        write.blocks.insert(write.blocks.end(), blocks.begin(), blocks.end());
    }
    return queue(std::move(write));
}

void PostgresRecords::setSavedEdit(std::int64_t number) {
    QueuedWrite write;
    write.commands.push_back(setSavedCommand(number));
    queue(std::move(write));
}

std::uint64_t PostgresRecords::durable() const {
    const std::lock_guard lock(mutex_);
    return told_;
}
std::string PostgresRecords::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
}

base::Result<void> PostgresRecords::flush() {
    std::unique_lock lock(mutex_);
    const std::uint64_t goal = queued_, before = attempts_;
    written_.wait(lock, [&] { return committed_ >= goal || (attempts_ > before && !problem_.empty()); });
    if (committed_ >= goal) return {};
    return base::fail(base::ErrorCode::Io, "{}", problem_);
}

net::SharedChanges PostgresRecords::popChanges() {
    const std::lock_guard lock(mutex_);
    basis_ = heard_;
    told_ = committed_;
    net::SharedChanges next;
    next.newest = news_.newest;
    next.saved = news_.saved;
    return std::exchange(news_, std::move(next));
}

void PostgresRecords::publishAddress(const std::string& address, const std::string& key) {
    const std::lock_guard lock(mutex_);
    name_.address = address;
    name_.key = key;
}

void PostgresRecords::say(const net::SharedLine& line) {
    tell(LineNote{line});
}
void PostgresRecords::publishPlace(const net::PlaceChange& change) {
    tell(PlaceNote{change});
}

void PostgresRecords::publishTime(double timeDay) {
    tell(TimeNote{static_cast<std::uint32_t>(timeDay * kTimeSteps)});
}
void PostgresRecords::publishPoses(std::span<const net::OtherPlayer> players) {
    for (std::size_t first = 0; first < players.size(); first += kMaxPosesInNote) {
        const auto part = players.subspan(first, std::min(kMaxPosesInNote, players.size() - first));
        tell(PosesNote{{part.begin(), part.end()}});
    }
}
void PostgresRecords::publishTiles(std::span<const world::ChunkPos> tiles) {
    for (std::size_t first = 0; first < tiles.size(); first += kMaxTilesInNote) {
        const auto part = tiles.subspan(first, std::min(kMaxTilesInNote, tiles.size() - first));
        tell(TilesNote{{part.begin(), part.end()}});
    }
}

void PostgresRecords::publishJoined(game::PlayerId player) {
    QueuedWrite write;
    write.commands.push_back(joinedCommand(player, server_));
    write.note = JoinedNote{player};
    queue(std::move(write));
    // What is known so far happened before.
    const std::lock_guard lock(mutex_);
    std::erase(news_.joined, player);
}
void PostgresRecords::publishLeft(game::PlayerId player) {
    QueuedWrite write;
    write.commands.push_back(leftCommand(player, server_));
    write.note = LeftNote{player};
    queue(std::move(write));
}

game::PlayerId PostgresRecords::allocatePlayerId() {
    const std::lock_guard lock(mutex_);
    if (numbers_.empty()) return game::kNoPlayer;
    const game::PlayerId number = numbers_.back();
    numbers_.pop_back();
    return number;
}

void PostgresRecords::publishState(int players, std::int64_t saved) {
    const std::lock_guard lock(mutex_);
    state_.players = players;
    state_.saved = saved;
}
void PostgresRecords::requestRegions(std::vector<net::Region> regions) {
    const std::lock_guard lock(mutex_);
    requestedRegions_ = {regions.begin(), regions.end()};
}
bool PostgresRecords::mayGrow(net::Region region) const {
    const std::lock_guard lock(mutex_);
    return Clock::now() < leasedUntil_ && leased_.contains(region);
}

void PostgresRecords::removeStoppedServer(std::int64_t server) {
    QueuedWrite write;
    write.commands.push_back(removeServerCommand(server));
    queue(std::move(write));
}

}  // namespace terrane::net_postgres
