// A separate PostgreSQL server in a folder, for tests: started, stopped, killed.
#pragma once

#include <filesystem>
#include <string>

namespace terrane::store_postgres {

class PostgresServer {
  public:
    // Creates its files and starts it. `folder` is empty or missing; since PostgreSQL does not run as root,
    // it then belongs to PostgreSQL's user. Throws if PostgreSQL is not installed.
    explicit PostgresServer(std::filesystem::path folder);
    ~PostgresServer();  // kills the server and removes its files
    PostgresServer(const PostgresServer&) = delete;
    PostgresServer& operator=(const PostgresServer&) = delete;

    void start();
    void stop();  // disconnects clients
    void kill();  // like a power failure

    // URL of the superuser, through a socket, without a password.
    std::string url(const std::string& parameters = "") const;
    // URL through the network, where a password is required.
    std::string networkUrl(const std::string& userAndPassword) const;
    int port() const { return port_; }

    // Runs SQL as the superuser. Throws on failure.
    void sql(const std::string& text) const;
    std::string query(const std::string& text) const;  // one value

  private:
    std::filesystem::path folder_;
    int port_ = 0;
};

// The server shared by all tests of a program, started on first use.
PostgresServer& sharedServer();
// A schema name unique to the test.
std::string freshSchema();

}  // namespace terrane::store_postgres
