#include "terrane/base/tcp_peer.h"

#include <algorithm>
#include <cstdint>

namespace terrane::base {

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
