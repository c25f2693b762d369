// Connects a server to a network: TCP with TLS 1.3, carrying frames. The number and duration of connections
// that do not play are limited: an address that opens many loses its oldest ones. On the server's thread,
// which runs the context.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/server/server_state.h"

namespace boost::asio {
class io_context;
}

namespace terrane::net {

struct ListenAddress {
    std::string address = "::";  // all addresses, including IPv4
    std::uint16_t port = 25560;  // 0: any free port
};
// Maximum number of connections that do not play yet.
constexpr std::size_t kMaxPendingConnections = 256;

class ServerSockets {
  public:
    // Starts to listen. The server and the context outlive this; `keyFile`: see security.h.
    [[nodiscard]] static base::Result<std::unique_ptr<ServerSockets>> open(
        boost::asio::io_context& context, ServerState& server, const ListenAddress& address,
        const std::filesystem::path& keyFile);
    ~ServerSockets();

    std::uint16_t port() const;
    std::string key() const;  // SHA-256 of the server's public key, in hexadecimal digits

    // Sends the outgoing bytes of all clients, and closes connections that the server ended. Call after each
    // tick.
    void flush();
    void stopListening();
    std::size_t connectionCount() const;

  private:
    struct Impl;
    explicit ServerSockets(std::shared_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;  // the context's last handlers may outlive this
};

}  // namespace terrane::net
