// A world in its own schema of the shared server, for tests of faults and of sharing.
#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <string>

#include "terrane/store_postgres/postgres_store.h"
#include "tests/store/store_fixture.h"
#include "tests/store_postgres/postgres_server.h"

namespace terrane::store_postgres {

inline const store::SaveAccess kCreateWorld{.create = store::kIdentity, .decide = {}};
inline const store::SaveAccess kWorldMustBeThere{};

inline store::SaveAccess regenerateBy(int version, store::Regenerate chunks = store::Regenerate::All) {
    return {.create = {}, .decide = [=](const store::WorldIdentity&) {
                return base::Result<store::Regeneration>({chunks, version});
            }};
}

// Existing parameters of the URL stay.
inline Address addressIn(const PostgresServer& server, const std::string& schema,
                         const std::string& parameters = "") {
    return addressOf(server.url("schema=" + schema + "&" + parameters)).value();
}

// The URL of the shared server with another database, or another user.
inline std::string urlWith(const std::string& database, const std::string& user = "postgres") {
    std::string url = sharedServer().url();
    url.replace(url.find("///postgres?"), 12, "///" + database + "?");
    url.replace(url.find("user=postgres"), 13, "user=" + user);
    return url;
}

// Creates a database in the shared server and returns its name.
inline std::string freshDatabase(const std::string& options = "") {
    std::string name = "database_" + freshSchema();
    sharedServer().sql("CREATE DATABASE " + name + options);
    return name;
}

// Expects a one-line error that names `where` and the reason.
inline void expectError(const base::Error& error, base::ErrorCode code, const std::string& where,
                        const std::string& reason) {
    EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(code)) << error.message;
    EXPECT_THAT(error.message, testing::StartsWith(where + ": "));
    EXPECT_THAT(error.message, testing::HasSubstr(reason));
    EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
}

// The error of an operation that is expected to fail.
template <class T>
base::Error errorOf(const base::Result<T>& result) {
    return result ? base::Error{base::ErrorCode::Failed, "no error"} : result.error();
}

class PostgresWorldTest : public testing::Test {
  protected:
    using Opened = base::Result<std::unique_ptr<PostgresStore>>;

    Opened tryOpen(const store::SaveAccess& access = kCreateWorld,
                   store::WorldSharing sharing = store::WorldSharing::Alone, RetryTimes times = {}) {
        return PostgresStore::open(address_, registry_, access, sharing, store::kNever, times);
    }
    std::unique_ptr<PostgresStore> open(store::WorldSharing sharing = store::WorldSharing::Alone) {
        auto store = tryOpen(kCreateWorld, sharing);
        if (!store) throw std::runtime_error(store.error().message);
        return std::move(*store);
    }
    // Creates a world with edited chunks x,0 with the numbers x.
    void makeWorld(int chunks = 3) {
        const auto store = open();
        for (int x = 0; x < chunks; ++x)
            store->save({x, 0}, store::numberedChunk(x), store::Provenance::Edited);
        ASSERT_TRUE(store->flush());
    }
    // Runs SQL like another program, without the module's rules.
    void sql(const std::string& text) { (void)query(text); }
    std::string query(const std::string& text) {
        return sharedServer().query("SET client_min_messages = error; SET search_path = \"" + schema_ +
                                    "\"; " + text);
    }
    // Ends the connections of the store whose URL names this program, and waits until they are closed.
    void cutConnectionsOf(const std::string& program) {
        sharedServer().sql(
            "SELECT pg_terminate_backend(pid, 5000) FROM pg_stat_activity "
            "WHERE application_name = '" +
            program + "'");
    }

    std::string schema_ = freshSchema();
    Address address_ = addressIn(sharedServer(), schema_);
    world::BlockRegistry registry_ = store::testRegistry();
};

}  // namespace terrane::store_postgres
