// A client's end of a connection: TCP with TLS 1.3, and messages as frames. Used on the thread that runs the
// context; its events come from there.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/wire.h"

namespace boost::asio {
class io_context;
}

namespace terrane::net {

struct ServerAddress {
    std::string host;
    std::uint16_t port = 25560;
};
// "example.org", "example.org:4000", "[::1]:4000".
[[nodiscard]] base::Result<ServerAddress> serverAddress(const std::string& text);
std::string textOf(const ServerAddress& address);

struct SocketEvents {
    // `serverKey`: 64 hexadecimal digits by which the server is known. `channel`: the exported keying
    // material.
    std::function<void(const Bytes& channel, const std::string& serverKey)> opened;
    std::function<void(ByteView message)> message;
    // Once, and nothing after it. Not where the socket was closed by close() or destroyed.
    std::function<void(const std::string& reason)> closed;
};

class ClientSocket {
  public:
    // Connects; all else happens while the context runs.
    ClientSocket(boost::asio::io_context& context, const ServerAddress& address, SocketEvents events);
    ~ClientSocket();
    ClientSocket(ClientSocket&&) noexcept;
    ClientSocket& operator=(ClientSocket&&) noexcept;

    void send(ByteView message);
    void close();

    // Bytes of the network's stream, before and after TLS is on it.
    std::uint64_t receivedBytes() const;
    std::uint64_t sentBytes() const;

  private:
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

}  // namespace terrane::net
