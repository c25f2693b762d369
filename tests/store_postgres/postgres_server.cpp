#include "tests/store_postgres/postgres_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <libpq-fe.h>
#include <pwd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace terrane::store_postgres {
namespace {

namespace fs = std::filesystem;

fs::path programs() {
    for (const auto& version : fs::directory_iterator("/usr/lib/postgresql"))
        if (fs::exists(version.path() / "bin" / "initdb")) return version.path() / "bin";
    throw std::runtime_error("PostgreSQL is not installed: apt-get install postgresql-15");
}

void shell(const std::string& command) {
    const std::string asUser =
        ::geteuid() == 0 ? "setpriv --reuid postgres --regid postgres --clear-groups -- " : "";
    if (std::system((asUser + command).c_str()) != 0) throw std::runtime_error(command);
}

void giveToPostgres(const fs::path& folder) {
    if (::geteuid() != 0) return;
    const passwd* user = ::getpwnam("postgres");
    if (!user || ::chown(folder.c_str(), user->pw_uid, user->pw_gid) != 0)
        throw std::runtime_error("no user postgres");
}

int freePort() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
    ::close(socket);
    return ntohs(address.sin_port);
}

}  // namespace

PostgresServer::PostgresServer(fs::path folder) : folder_(std::move(folder)), port_(freePort()) {
    fs::create_directories(folder_);
    giveToPostgres(folder_);
    std::ofstream(folder_ / "password") << "secret\n";
    shell(
        fmt::format("{}/initdb -D {}/data -U postgres -E UTF8 --no-locale --no-sync --pwfile={}/password "
                    "--auth-local=trust --auth-host=scram-sha-256 >{}/initdb.log",
                    programs().string(), folder_.string(), folder_.string(), folder_.string()));
    start();
}

PostgresServer::~PostgresServer() {
    try {
        kill();
    } catch (const std::exception&) {
    }
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void PostgresServer::start() {
    shell(fmt::format(
        "{}/pg_ctl -D {}/data -l {}/log -w -t 60 -s -o \"-k {} -p {} -c listen_addresses=127.0.0.1 "
        "-c fsync=off -c max_connections=60 -c shared_buffers=16MB\" start",
        programs().string(), folder_.string(), folder_.string(), folder_.string(), port_));
}

void PostgresServer::stop() {
    shell(fmt::format("{}/pg_ctl -D {}/data -m fast -w -s stop", programs().string(), folder_.string()));
}

void PostgresServer::kill() {
    shell(fmt::format("{}/pg_ctl -D {}/data -m immediate -w -s stop 2>/dev/null", programs().string(),
                      folder_.string()));
}

std::string PostgresServer::url(const std::string& parameters) const {
    return fmt::format("postgresql:///postgres?host={}&port={}&user=postgres{}{}", folder_.string(), port_,
                       parameters.empty() ? "" : "&", parameters);
}

std::string PostgresServer::networkUrl(const std::string& userAndPassword) const {
    return fmt::format("postgresql://{}@127.0.0.1:{}/postgres", userAndPassword, port_);
}

void PostgresServer::sql(const std::string& text) const {
    (void)query(text);
}

std::string PostgresServer::query(const std::string& text) const {
    const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectdb(url().c_str()), PQfinish);
    const std::unique_ptr<PGresult, decltype(&PQclear)> result(PQexec(connection.get(), text.c_str()),
                                                               PQclear);
    const auto status = PQresultStatus(result.get());
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK)
        throw std::runtime_error(PQerrorMessage(connection.get()));
    return PQntuples(result.get()) > 0 ? PQgetvalue(result.get(), 0, 0) : "";
}

PostgresServer& sharedServer() {
    // Not in a base::TempFolder, which the next TempFolder of a test would remove.
    static PostgresServer server(fs::temp_directory_path() / fmt::format("terrane_postgres_{}", ::getpid()));
    return server;
}

std::string freshSchema() {
    static int number = 0;
    return fmt::format("world_{}", ++number);
}

}  // namespace terrane::store_postgres
