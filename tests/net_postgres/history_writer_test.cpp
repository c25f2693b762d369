// Batches whose COMMIT is never confirmed to the server: they are in the history once and in order, and all
// reports agree with it.
#include "terrane/net_postgres/history_writer.h"

#include <sys/socket.h>

#include <future>

#include "terrane/net_postgres/record_rows.h"
#include "terrane/net_postgres/server_rows.h"
#include "terrane/store/chunks/chunk_key.h"
#include "tests/base/temp_folder.h"
#include "tests/net_postgres/shared_server_fixture.h"

namespace terrane::net_postgres {
namespace {

using store_postgres::Connection;

net::LoggedEdit editOf(std::string_view block) {
    return {0,
            1000,
            5,
            {1, -2},
            {{7, world::BlockValue{}}},
            {{7, world::BlockValue{contentBlock(block), 0, {}}}}};
}

// A world in its own database, where commits of transactions that write to certain tables wait for a
// synchronous replica that does not exist. A waiting transaction is already durable.
class HistoryWriterTest : public testing::Test {
  protected:
    HistoryWriterTest() {
        postgres_.sql("ALTER SYSTEM SET synchronous_commit = local");
        postgres_.sql("ALTER SYSTEM SET synchronous_standby_names = nobody");
        postgres_.sql("SELECT pg_reload_conf()");
        sharedParts(address_);  // creates the world
        blocks_ = net::ownBlocks();
        ids_ = store_postgres::openToRead(address_, *blocks_)->contents.ids;
        connection_.emplace(open());
        for (std::int64_t& server : servers_) server = addServer(*connection_, {"test", "", ""}).value();
        writer_.emplace(address_, ids_, "test", servers_[0], 0);
    }

    Connection open() { return Connection::open(address_).value(); }
    void makeEndsWait(const std::string& table) {
        postgres_.sql(
            "CREATE FUNCTION wait_at_end() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
            "PERFORM set_config('synchronous_commit', 'on', true); RETURN NULL; END $$; "
            "CREATE TRIGGER waits AFTER INSERT ON terrane." +
            table + " EXECUTE FUNCTION wait_at_end()");
    }
    bool waitForEnd() {
        for (int k = 0; k < 2000; ++k) {
            if (postgres_.query("SELECT count(*) FROM pg_stat_activity WHERE wait_event = 'SyncRep'") == "1")
                return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }
    void let() {
        postgres_.sql("ALTER SYSTEM SET synchronous_standby_names = ''");
        postgres_.sql("SELECT pg_reload_conf()");
    }
    // Writes a batch up to its commit, where `cut` breaks the connection.
    template <class Cut>
    void writeAndCut(const std::vector<QueuedWrite>& batch, Cut cut) {
        Heard heard;
        auto written =
            std::async(std::launch::async, [&] { return writer_->write(*connection_, batch, heard); });
        ASSERT_TRUE(waitForEnd());
        cut();
        ASSERT_FALSE(written.get());
        EXPECT_FALSE(heard.isWritten);
        connection_.emplace(open());
    }
    void terminate() {
        postgres_.query(
            "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE wait_event = 'SyncRep'");
    }
    QueuedWrite write(std::uint64_t number, const net::LoggedEdit& edit) {
        QueuedWrite write;
        write.number = number;
        write.edits.push_back({edit.timeMs, 5, store::keyOf(edit.chunk), net::encodeEdit(edit, ids_)});
        write.blocks = blocksOf(edit);
        return write;
    }

    base::TempFolder folder_;
    store_postgres::PostgresServer postgres_{folder_ / "postgres"};
    store_postgres::Address address_ = store_postgres::addressOf(postgres_.url()).value();
    std::unique_ptr<const world::BlockRegistry> blocks_;
    store::BlockIdMap ids_;
    std::optional<Connection> connection_;
    std::array<std::int64_t, 2> servers_{};
    std::optional<HistoryWriter> writer_;
};

// Another server appends before this one reconnects: its edit is the later one.
TEST_F(HistoryWriterTest, ACommitThatWasNotHeardOfComesBeforeWhatFollowedIt) {
    makeEndsWait("edits");
    const std::vector<QueuedWrite> batch{write(11, editOf("stone"))};
    writeAndCut(batch, [&] { terminate(); });
    let();
    HistoryWriter other(address_, ids_, "test", servers_[1], 0);
    Heard heardThere;
    QueuedWrite later = write(3, editOf("dirt"));
    ASSERT_TRUE(other.readOthers(*connection_, heardThere));
    ASSERT_EQ(heardThere.events.size(), 1u) << "the first one is committed";
    later.basis = heardThere.events[0].heard;
    ASSERT_TRUE(other.write(*connection_, {later}, heardThere));

    Heard heard;
    ASSERT_TRUE(writer_->readOthers(*connection_, heard));
    EXPECT_TRUE(heard.isWritten);
    ASSERT_EQ(heard.events.size(), 2u);
    const auto* decision = std::get_if<net::WriteDecision>(&heard.events[0].event);
    ASSERT_NE(decision, nullptr);
    EXPECT_EQ(decision->write, 11u);
    EXPECT_TRUE(decision->isAccepted);
    EXPECT_EQ(decision->firstNumber, 1);
    const auto* edit = std::get_if<net::LoggedEdit>(&heard.events[1].event);
    ASSERT_NE(edit, nullptr);
    EXPECT_EQ(edit->number, 2);
    EXPECT_EQ(writer_->seen(), 2);
    EXPECT_EQ(postgres_.query("SELECT count(*) FROM terrane.edits"), "2");
}

// The network breaks while the database is still committing: an immediate read does not see the transaction.
TEST_F(HistoryWriterTest, ACommitThatIsStillGoingOnIsWaitedFor) {
    makeEndsWait("edits");
    const std::vector<QueuedWrite> batch{write(11, editOf("stone"))};
    writeAndCut(batch, [&] { ::shutdown(connection_->socket(), SHUT_RDWR); });
    Heard heard;
    auto written = std::async(std::launch::async, [&] { return writer_->write(*connection_, batch, heard); });
    EXPECT_EQ(written.wait_for(std::chrono::milliseconds(300)), std::future_status::timeout);
    let();
    const auto done = written.get();
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_TRUE(heard.isWritten);
    ASSERT_EQ(heard.events.size(), 1u);
    EXPECT_TRUE(std::get<net::WriteDecision>(heard.events[0].event).isAccepted);
    EXPECT_EQ(postgres_.query("SELECT count(*) FROM terrane.edits"), "1");
    EXPECT_EQ(postgres_.query("SELECT newest FROM terrane.history"), "1");
}

TEST_F(HistoryWriterTest, APlayerWhoIsThereAlreadyIsNotRefused) {
    makeEndsWait("players");
    const net::KnownPlayer anna{5, net::newPlayerKey().publicKey, "Anna", game::Role::Player, {}, ""};
    QueuedWrite adds;
    adds.number = 1;
    adds.commands = {addPlayerCommand(anna)};
    adds.added = {anna.id, anna.key};
    writeAndCut({adds}, [&] { terminate(); });
    let();
    Heard heard;
    ASSERT_TRUE(writer_->write(*connection_, {adds}, heard));
    EXPECT_TRUE(heard.refused.empty());
    EXPECT_TRUE(heard.isWritten);

    net::KnownPlayer other{6, net::newPlayerKey().publicKey, "ANNA", game::Role::Player, {}, ""};
    adds.commands = {addPlayerCommand(other)};
    adds.added = {other.id, other.key};
    Heard second;
    ASSERT_TRUE(writer_->write(*connection_, {adds}, second));
    EXPECT_EQ(second.refused, std::vector<game::PlayerId>{6});
}

}  // namespace
}  // namespace terrane::net_postgres
