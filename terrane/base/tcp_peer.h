// Addresses of the other end of TCP connections. Any thread.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <string>

namespace terrane::base {

// The peer's address; an IPv4-mapped IPv6 address becomes IPv4.
boost::asio::ip::address addressOf(const boost::asio::ip::tcp::endpoint& peer);
// The key for limits per address: of IPv6 only the first 64 bits, since a network of 2^64 addresses usually
// belongs to one client.
std::string networkOf(const boost::asio::ip::address& address);

}  // namespace terrane::base
