// Whose connection it is. Any thread.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <string>

namespace terrane::base {

// An IPv4 address that came as IPv6 is one of IPv4.
boost::asio::ip::address addressOf(const boost::asio::ip::tcp::endpoint& peer);
// What limits for an address count by: of IPv6 the first 64 bits, as whoever has an address has 2^64 of them.
std::string networkOf(const boost::asio::ip::address& address);

}  // namespace terrane::base
