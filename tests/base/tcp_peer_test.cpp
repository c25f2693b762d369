#include "terrane/base/tcp.h"

#include <gtest/gtest.h>

namespace terrane::base {
namespace {

std::string networkOfText(const char* address) {
    return networkOf(addressOf({boost::asio::ip::make_address(address), 1234}));
}

TEST(TcpPeer, IPv4AddressesCountByThemselves) {
    EXPECT_EQ(networkOfText("192.0.2.7"), "192.0.2.7");
    EXPECT_EQ(networkOfText("::ffff:192.0.2.7"), "192.0.2.7") << "as one that came as IPv6";
    EXPECT_NE(networkOfText("192.0.2.7"), networkOfText("192.0.2.8"));
}

TEST(TcpPeer, IPv6AddressesCountByTheirNetwork) {
    EXPECT_EQ(networkOfText("2001:db8:1:2::1"), networkOfText("2001:db8:1:2:ffff::9"));
    EXPECT_NE(networkOfText("2001:db8:1:2::1"), networkOfText("2001:db8:1:3::1"));
}

}  // namespace
}  // namespace terrane::base
