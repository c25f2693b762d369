#include "terrane/base/tcp.h"

#include <boost/asio/ip/v6_only.hpp>

#include <algorithm>
#include <cstdint>

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

namespace asio = boost::asio;

asio::ip::address addressOf(const asio::ip::tcp::endpoint& peer) {
    const auto address = peer.address();
    const bool isMapped = address.is_v6() && address.to_v6().is_v4_mapped();
    return isMapped ? asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()) : address;
}

std::string networkOf(const asio::ip::address& address) {
    if (address.is_v4()) return address.to_string();
    auto bytes = address.to_v6().to_bytes();
    std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
    return asio::ip::address_v6(bytes).to_string();
}

}  // namespace terrane::base
