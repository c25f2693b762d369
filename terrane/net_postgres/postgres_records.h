// A server's records in PostgreSQL, shared by all servers of the world. A thread of this class writes and
// listens.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "terrane/net/server/edit_log.h"
#include "terrane/net/sharing/shared_world.h"
#include "terrane/net_postgres/history_writer.h"
#include "terrane/net_postgres/server_rows.h"
#include "terrane/store_postgres/connection.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::net_postgres {

// Reads the edit history of a world, also while servers run.
[[nodiscard]] base::Result<net::History> readHistory(const store_postgres::Address& address,
                                                     const world::BlockRegistry& blocks);

class PostgresRecords : public net::ServerRecords, public net::SharedWorld {
  public:
    // Opens the records of an existing world that is open with WorldSharing::Servers. Registers the server
    // until this is destroyed.
    [[nodiscard]] static base::Result<std::unique_ptr<PostgresRecords>> open(
        const store_postgres::Address& address, const world::BlockRegistry& blocks, const ServerName& name);
    // Opens for reading players, claims, texts and edits only; changes nothing in the database.
    [[nodiscard]] static base::Result<std::unique_ptr<PostgresRecords>> openToRead(
        const store_postgres::Address& address, const world::BlockRegistry& blocks, const ServerName& name);
    ~PostgresRecords() override;  // commits queued writes, for up to 10 s
    PostgresRecords(const PostgresRecords&) = delete;
    PostgresRecords& operator=(const PostgresRecords&) = delete;

    [[nodiscard]] base::Result<std::vector<net::KnownPlayer>> players() override;
    [[nodiscard]] base::Result<std::vector<game::Claim>> claims() override;
    [[nodiscard]] base::Result<std::string> text(const std::string& name) override;
    [[nodiscard]] base::Result<net::HistoryEnds> historyEnds() override;
    [[nodiscard]] base::Result<void> forEachEdit(const net::EditFilter& filter, net::EditOrder order,
                                                 const net::UseEdit& use) override;
    void addPlayer(const net::KnownPlayer& player) override;
    void changePlayer(game::PlayerId id, const net::PlayerChange& change) override;
    void addClaim(const game::Claim& claim) override;
    void removeClaim(const std::string& name) override;
    void setText(const std::string& name, const std::string& text) override;
    std::uint64_t append(const std::vector<net::LoggedEdit>& edits) override;
    void setSavedEdit(std::int64_t number) override;  // for copies: servers call publishState()
    // The last write that is decided and was reported by popChanges().
    std::uint64_t durable() const override;
    std::string problem() const override;
    [[nodiscard]] base::Result<void> flush() override;
    net::SharedWorld* shared() override { return this; }

    // Sets the address at which players reach the server.
    void publishAddress(const std::string& address, const std::string& key);

    net::SharedChanges popChanges() override;
    void say(const net::SharedLine& line) override;
    void publishTime(double timeDay) override;
    void publishPlace(const net::PlaceChange& change) override;
    void publishPoses(std::span<const net::OtherPlayer> players) override;
    void publishTiles(std::span<const world::ChunkPos> tiles) override;
    void publishJoined(game::PlayerId player) override;
    void publishLeft(game::PlayerId player) override;
    game::PlayerId allocatePlayerId() override;
    void publishState(int players, std::int64_t saved) override;
    void requestRegions(std::vector<net::Region> regions) override;
    bool mayGrow(net::Region region) const override;

    void removeStoppedServer(std::int64_t server) override;

  private:
    using Clock = std::chrono::steady_clock;
    PostgresRecords(const store_postgres::Address& address, store_postgres::WorldContents contents,
                    ServerName name);

    std::uint64_t queue(QueuedWrite write);
    void tell(const Note& note);
    void wake();
    // On thread_.
    void run();
    void waitForWork();
    base::Result<void> work();
    base::Result<void> connect();
    base::Result<void> listen();
    base::Result<void> lookUp();
    bool joinsHere(game::PlayerId player) const;  // with mutex_ locked
    void keepNotices();
    base::Result<void> takeNotes(Heard& heard);
    base::Result<void> takeNote(const Note& note, bool& hasEdits);
    base::Result<void> writeQueued(Heard& heard);
    base::Result<void> sendNotes();
    base::Result<void> beatIfDue();
    base::Result<void> findUnsaved(std::vector<net::OtherServer>& others);
    base::Result<void> reservePlayerNumbers();
    void hand(Heard heard);

    store_postgres::ConnectionPool pool_;  // for blocking calls of the server's thread
    store_postgres::WorldContents contents_;
    ServerName name_;
    std::string channel_;
    std::int64_t server_ = 0;
    int wakeSocket_ = -1;  // an eventfd

    // Used by thread_ only.
    std::optional<store_postgres::Connection> connection_;
    std::unique_ptr<HistoryWriter> writer_;
    std::vector<QueuedWrite> batch_;  // being written
    std::size_t oneByOne_ = 0;        // number of writes to try one at a time
    std::vector<store_postgres::Notification> notices_;
    bool mustLookUp_ = false;  // notes were missed
    Clock::time_point nextLook_{}, nextBeat_{};
    std::map<std::int64_t, std::vector<world::ChunkPos>> gone_;  // stopped servers and their unsaved chunks

    mutable std::mutex mutex_;  // guards all members below
    std::condition_variable written_;
    std::deque<QueuedWrite> queue_;
    std::deque<Note> notes_;  // to be sent
    std::uint64_t queued_ = 0, committed_ = 0, told_ = 0;
    std::uint64_t attempts_ = 0;
    std::uint64_t basis_ = 0, heard_ = 0;  // last event reported to the server; last event in news_
    net::SharedChanges news_;
    std::vector<game::PlayerId> numbers_;  // for new players
    std::set<net::Region> requestedRegions_, leased_;
    Clock::time_point leasedUntil_{};
    ServerBeat state_;
    std::string problem_;
    bool isEnding_ = false;
    std::thread thread_;
};

}  // namespace terrane::net_postgres
