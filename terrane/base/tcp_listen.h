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

}  // namespace terrane::base
