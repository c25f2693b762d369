// Puts a server on a network: TCP with TLS 1.3, and messages as frames. Connections that are no players are
// few and short: whoever opens many loses the oldest ones. On the server's thread, which runs the context.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/server_state.h"

namespace boost::asio {
class io_context;
}

namespace terrane::net {

struct ListenAddress {
    std::string address = "::";  // all addresses, of IPv4 too
    std::uint16_t port = 25560;  // 0: one that is free
};
// Connections that do not play yet.
constexpr std::size_t kMaxPendingConnections = 256;

class ServerSockets {
  public:
    // Listens from here on. The server and the context outlive this; `keyFile`: tls.h.
    [[nodiscard]] static base::Result<std::unique_ptr<ServerSockets>> open(
        boost::asio::io_context& context, ServerState& server, const ListenAddress& address,
        const std::filesystem::path& keyFile);
    ~ServerSockets();

    std::uint16_t port() const;
    std::string key() const;  // SHA-256 of the server's public key, in hexadecimal digits

    // Sends what the server has for its clients, and closes connections that it ended. After each tick.
    void flush();
    void stopListening();
    std::size_t connectionCount() const;

  private:
    struct Impl;
    explicit ServerSockets(std::shared_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;  // what the context runs last may come after this
};

}  // namespace terrane::net
