#include "terrane/web/host_check.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <optional>

namespace terrane::web {
namespace {

namespace ip = boost::asio::ip;

constexpr std::size_t kMaxHostName = 253;  // bytes, RFC 1035
constexpr std::string_view kDigits = "0123456789";

char lowered(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool isSame(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, lowered, lowered);
}

std::optional<ip::address> addressIn(std::string_view text) {
    boost::system::error_code wrong;
    const ip::address address = ip::make_address(std::string(text), wrong);
    if (wrong) return std::nullopt;
    const bool isMapped = address.is_v6() && address.to_v6().is_v4_mapped();
    return isMapped ? ip::address(ip::make_address_v4(ip::v4_mapped, address.to_v6())) : address;
}

// The host of "HOST" or "HOST:PORT", without brackets and the dot of a complete name; none if it is neither.
std::optional<std::string_view> hostIn(std::string_view text) {
    const bool isBracketed = text.starts_with('[');
    const std::size_t end = isBracketed ? text.find(']') : std::min(text.find(':'), text.size());
    if (end == text.npos) return std::nullopt;
    std::string_view host = text.substr(isBracketed, end - isBracketed),
                     port = text.substr(end + isBracketed);
    const bool hasPort = port.starts_with(':') && port.find_first_not_of(kDigits, 1) == port.npos;
    if (!port.empty() && !hasPort) return std::nullopt;
    if (isBracketed != (host.find(':') != host.npos)) return std::nullopt;
    if (host.ends_with('.')) host.remove_suffix(1);
    return host.empty() ? std::nullopt : std::optional(host);
}

bool isNamed(std::string_view host, const std::vector<std::string>& names) {
    const auto address = addressIn(host);
    return std::ranges::any_of(names, [&](const std::string& name) {
        return isSame(host, name) || (address && address == addressIn(name));
    });
}

bool isOwnAddress(const ip::address& address, const std::string& listens) {
    const auto own = addressIn(listens);
    return address.is_loopback() || (own && (own->is_unspecified() || *own == address));
}

}  // namespace

bool isHostName(std::string_view text) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._";
    if (addressIn(text)) return true;
    return !text.empty() && text.size() <= kMaxHostName && text.front() != '.' && text.back() != '.' &&
           text.find_first_not_of(kLetters) == text.npos;
}

bool isOwnHost(std::string_view host, const OwnHosts& own) {
    const auto name = hostIn(host);
    if (!name) return false;
    if (isSame(*name, "localhost") || isNamed(*name, own.names)) return true;
    const auto address = addressIn(*name);
    return address && isOwnAddress(*address, own.address);
}

bool isOwnOrigin(std::string_view origin, std::string_view host, const OwnHosts& own) {
    constexpr std::string_view kEnd = "://";
    const std::size_t scheme = origin.find(kEnd);
    if (scheme == origin.npos) return false;  // "null"
    const std::string_view from = origin.substr(scheme + kEnd.size());
    const auto name = hostIn(from);
    return name && (isSame(from, host) || isNamed(*name, own.names));
}

}  // namespace terrane::web
