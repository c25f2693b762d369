// Which hosts a browser may name. A page of another site can make its own name stand for an address of this
// machine or its network (DNS rebinding), and would then read the map as its own. Pure functions; any thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace terrane::web {

// A host name ("map.example.org") or an address ("203.0.113.5", "::1"), as --map-host takes it.
bool isHostName(std::string_view text);

// The server's own hosts: localhost and loopback addresses, the address on which it listens (all addresses,
// if it listens on all), and these names.
struct OwnHosts {
    std::string address;  // on which the server listens
    std::vector<std::string> names = {};
};

// `host`: a Host field, "NAME", "NAME:PORT", "[::1]:PORT". Any port is accepted: proxies and forwarded ports
// have others.
bool isOwnHost(std::string_view host, const OwnHosts& own);

// `origin`: an Origin field, "https://NAME:PORT". It is the server's own if it is the host of the request, or
// one of its names, which a proxy may replace in Host.
bool isOwnOrigin(std::string_view origin, std::string_view host, const OwnHosts& own);

}  // namespace terrane::web
