// Opens a port for a server. Called on the acceptor's thread.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include <cstdint>
#include <string>

#include "terrane/base/result.h"

namespace terrane::base {

// `address` is numeric, such as 127.0.0.1; "::" accepts IPv4 as well. Port 0 chooses a free port. BadInput if
// it is no address; otherwise Busy if another program listens there, else Io, with address and port.
[[nodiscard]] Result<void> listenAt(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                                    std::uint16_t port);

// Addresses of the other end of TCP connections. Any thread.
// The peer's address; an IPv4-mapped IPv6 address becomes IPv4.
boost::asio::ip::address addressOf(const boost::asio::ip::tcp::endpoint& peer);
// The key for limits per address: of IPv6 only the first 64 bits, since a network of 2^64 addresses usually
// belongs to one client.
std::string networkOf(const boost::asio::ip::address& address);

}  // namespace terrane::base
