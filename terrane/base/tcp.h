// Listening sockets and the addresses of TCP connections. The functions have no state.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include <cstdint>
#include <string>

#include "terrane/base/result.h"

namespace terrane::base {

// Opens a port for a server, on the acceptor's thread. `address` is numeric, such as 127.0.0.1; "::" accepts
// IPv4 as well. Port 0 chooses a free port. Returns BadInput if it is no address; otherwise Busy if another
// program listens there, else Io, with address and port.
[[nodiscard]] Result<void> listenAt(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                                    std::uint16_t port);

// Returns the peer's address; an IPv4-mapped IPv6 address becomes IPv4. Any thread may call it.
boost::asio::ip::address addressOf(const boost::asio::ip::tcp::endpoint& peer);
// Returns the key for limits per address. It has only the first 64 bits of an IPv6 address, since a network
// of 2^64 addresses usually belongs to one client.
std::string networkOf(const boost::asio::ip::address& address);

}  // namespace terrane::base
