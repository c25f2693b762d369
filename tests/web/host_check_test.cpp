#include "terrane/web/host_check.h"

#include <gtest/gtest.h>

namespace terrane::web {
namespace {

TEST(HostCheck, LocalhostAndLoopbackAreOwn) {
    const OwnHosts own{"127.0.0.1"};
    for (const char* host : {"localhost", "LocalHost:8080", "localhost.", "127.0.0.1", "127.0.0.1:8080",
                             "127.5.5.5", "[::1]:8080", "[::1]", "[::ffff:127.0.0.1]:1"})
        EXPECT_TRUE(isOwnHost(host, own)) << host;
    for (const char* host : {"evil.example",
                             "evil.example:8080",
                             "127.0.0.1.evil.example",
                             "localhost.evil.example",
                             "192.168.1.5",
                             "192.168.1.5:8080",
                             "[fe80::1]",
                             "",
                             ":8080",
                             "[",
                             "[]",
                             "[::1",
                             "::1",
                             "localhost:80x",
                             "localhost:80:80",
                             "user@localhost",
                             "127.1",
                             "2130706433",
                             "0.0.0.0",
                             "localhost/",
                             "[localhost]"})
        EXPECT_FALSE(isOwnHost(host, own)) << host;
}

TEST(HostCheck, TheAddressAndTheNamesAreOwn) {
    const OwnHosts one{"192.168.1.5", {"map.example.org", "203.0.113.5", "2001:db8::5"}};
    for (const char* host : {"192.168.1.5:8080", "map.example.org", "MAP.example.org.:443", "203.0.113.5",
                             "[2001:DB8:0::5]:8080", "localhost"})
        EXPECT_TRUE(isOwnHost(host, one)) << host;
    for (const char* host :
         {"192.168.1.6", "example.org", "x.map.example.org", "map.example.org.evil.example"})
        EXPECT_FALSE(isOwnHost(host, one)) << host;
    for (const char* all : {"0.0.0.0", "::"}) {
        for (const char* host : {"192.168.1.6", "[2001:db8::1]:80", "203.0.113.5"})
            EXPECT_TRUE(isOwnHost(host, {all})) << host << ": no name that can change";
        EXPECT_FALSE(isOwnHost("evil.example", {all}));
    }
}

TEST(HostCheck, OriginsAreTheHostOfTheRequest) {
    const OwnHosts own{"127.0.0.1", {"map.example.org"}};
    EXPECT_TRUE(isOwnOrigin("http://localhost:8080", "localhost:8080", own));
    EXPECT_TRUE(isOwnOrigin("http://LOCALHOST:8080", "localhost:8080", own));
    EXPECT_TRUE(isOwnOrigin("https://map.example.org", "127.0.0.1:8080", own)) << "through a proxy";
    for (const char* origin : {"http://evil.example", "http://localhost:3000", "null", "", "localhost:8080",
                               "https://map.example.org.evil.example", "file://"})
        EXPECT_FALSE(isOwnOrigin(origin, "localhost:8080", own)) << origin;
}

TEST(HostCheck, HostNamesOfTheOption) {
    for (const char* good : {"map.example.org", "map", "my-map.example", "203.0.113.5", "2001:db8::5"})
        EXPECT_TRUE(isHostName(good)) << good;
    for (const char* bad : {"", ".", "a.", ".a", "http://map", "map:80", "map/", "a b", "[::1]", "mäp", "*"})
        EXPECT_FALSE(isHostName(bad)) << bad;
}

}  // namespace
}  // namespace terrane::web
