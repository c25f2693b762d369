// The client's end of a connection: TCP with TLS 1.3, carrying frames. Used on the thread that runs the
// context; its events come on that thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/wire/wire.h"

namespace boost::asio {
class io_context;
}

namespace terrane::net {

struct ServerAddress {
    std::string host;
    std::uint16_t port = 25560;
};
// Parses "example.org", "example.org:4000" or "[::1]:4000".
[[nodiscard]] base::Result<ServerAddress> serverAddress(const std::string& text);
std::string textOf(const ServerAddress& address);

struct SocketEvents {
    // `serverKey`: SHA-256 of the server's public key, 64 hexadecimal digits. `channel`: the exported keying
    // material.
    std::function<void(const Bytes& channel, const std::string& serverKey)> opened;
    std::function<void(ByteView message)> message;
    // Called once, as the last event. Not called after close() or destruction.
    std::function<void(const std::string& reason)> closed;
};

class ClientSocket {
  public:
    // Starts to connect; the rest happens while the context runs.
    ClientSocket(boost::asio::io_context& context, const ServerAddress& address, SocketEvents events);
    ~ClientSocket();
    ClientSocket(ClientSocket&&) noexcept;
    ClientSocket& operator=(ClientSocket&&) noexcept;

    void send(ByteView message);
    void close();

    // Bytes received and sent on the TCP stream, TLS included.
    std::uint64_t receivedBytes() const;
    std::uint64_t sentBytes() const;

  private:
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

}  // namespace terrane::net
