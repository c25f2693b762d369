// Addresses of servers as players type them.
#include <gtest/gtest.h>

#include "terrane/net/client/client_socket.h"

namespace terrane::net {
namespace {

TEST(ServerAddress, OfNamesAndNumbers) {
    const struct {
        const char *typed, *host;
        int port;
    } cases[] = {
        {"example.org", "example.org", 25560},
        {"example.org:4000", "example.org", 4000},
        {"127.0.0.1:65535", "127.0.0.1", 65535},
        {"::1", "::1", 25560},  // an IPv6 address without a port
        {"[::1]", "::1", 25560},
        {"[::1]:4000", "::1", 4000},
    };
    for (const auto& one : cases) {
        const auto address = serverAddress(one.typed);
        ASSERT_TRUE(address) << one.typed;
        EXPECT_EQ(address->host, one.host) << one.typed;
        EXPECT_EQ(address->port, one.port) << one.typed;
        EXPECT_EQ(serverAddress(textOf(*address))->host, one.host) << textOf(*address);
        EXPECT_EQ(serverAddress(textOf(*address))->port, one.port) << textOf(*address);
    }
}

TEST(ServerAddress, WhatIsNone) {
    for (const char* typed : {"", ":", ":4000", "example.org:", "example.org:0", "example.org:65536",
                              "example.org:4000x", "example.org:x", "[::1", "[::1]4000", "[::1]:", "[]:4000"})
        EXPECT_FALSE(serverAddress(typed)) << typed;
    EXPECT_TRUE(serverAddress(std::string(255, 'a')));
    EXPECT_FALSE(serverAddress(std::string(256, 'a')));
}

}  // namespace
}  // namespace terrane::net
