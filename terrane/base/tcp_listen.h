// Opens a port, for whatever server listens there. On the thread of the acceptor.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <string>

#include "terrane/base/result.h"

namespace terrane::base {

// `address` is a number, such as 127.0.0.1; "::" takes IPv4 as well. Port 0: one that is free. BadInput where
// it is no address, Busy where another program listens there, else Io; each names both.
[[nodiscard]] Result<void> listenAt(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                                    std::uint16_t port);

}  // namespace terrane::base
