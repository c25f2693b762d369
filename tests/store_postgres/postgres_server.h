// A PostgreSQL server of its own in a folder, for tests: started, stopped, killed.
#pragma once

#include <filesystem>
#include <string>

namespace terrane::store_postgres {

class PostgresServer {
  public:
    // Makes its files and starts it. `folder` is empty or not there; PostgreSQL does not run as root, so it
    // is given to its own user then. Throws where PostgreSQL is not installed.
    explicit PostgresServer(std::filesystem::path folder);
    ~PostgresServer();  // kills it, and removes its files
    PostgresServer(const PostgresServer&) = delete;
    PostgresServer& operator=(const PostgresServer&) = delete;

    void start();
    void stop();  // clients are cut off
    void kill();  // as a power cut would

    // Of the superuser, through a socket, without a password.
    std::string url(const std::string& parameters = "") const;
    // Through the network, where a password is asked for.
    std::string networkUrl(const std::string& userAndPassword) const;
    int port() const { return port_; }

    // Runs SQL as the superuser. Throws where it fails.
    void sql(const std::string& text) const;
    std::string query(const std::string& text) const;  // one value

  private:
    std::filesystem::path folder_;
    int port_ = 0;
};

// The server that all tests of a program share, started by the first.
PostgresServer& sharedServer();
// A name of a schema that no other test has.
std::string freshSchema();

}  // namespace terrane::store_postgres
