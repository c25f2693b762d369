#include "terrane/base/tcp_listen.h"

#include <boost/asio/ip/v6_only.hpp>

namespace terrane::base {

Result<void> listenAt(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                      std::uint16_t port) {
    namespace asio = boost::asio;
    boost::system::error_code error;
    const auto parsed = asio::ip::make_address(address, error);
    if (error)
        return fail(ErrorCode::BadInput, "{}: not an address to listen on, such as 127.0.0.1 or ::", address);
    const asio::ip::tcp::endpoint endpoint(parsed, port);
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(asio::ip::tcp::acceptor::reuse_address(true), error);
    if (!error && parsed.is_v6()) acceptor.set_option(asio::ip::v6_only(false), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (!error) return {};
    return fail(error == asio::error::address_in_use ? ErrorCode::Busy : ErrorCode::Io,
                "{} port {}: cannot listen: {}", address, port, error.message());
}

}  // namespace terrane::base
