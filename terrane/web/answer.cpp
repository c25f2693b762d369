#include "terrane/web/answer.h"

#include <fmt/format.h>
#include <boost/beast/http/status.hpp>

namespace terrane::web {
namespace {

namespace http = boost::beast::http;

// Security headers: no resources of other hosts, no scripts except the program's.
constexpr std::string_view kSafety =
    "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; form-action 'self'; base-uri 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n";

}  // namespace

std::string headerOf(const Answer& answer, bool keepsOpen) {
    std::string text =
        fmt::format("HTTP/1.1 {} {}\r\n", answer.status,
                    std::string_view(http::obsolete_reason(static_cast<http::status>(answer.status))));
    if (answer.status != 304)
        text += fmt::format("Content-Type: {}\r\nContent-Length: {}\r\n", answer.type,
                            answer.body ? answer.body->size() : 0);
    text += answer.maxAge > 0 ? fmt::format("Cache-Control: max-age={}\r\n", answer.maxAge)
                              : std::string("Cache-Control: no-cache\r\n");
    if (!answer.tag.empty()) text += fmt::format("ETag: \"{}\"\r\n", answer.tag);
    if (answer.retryAfter > 0) text += fmt::format("Retry-After: {}\r\n", answer.retryAfter);
    if (answer.status == 405) text += "Allow: GET, HEAD\r\n";
    if (!keepsOpen) text += "Connection: close\r\n";
    text += kSafety;
    return text + "\r\n";
}

std::string streamHeader() {
    return fmt::format(
        "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nX-Accel-Buffering: "
        "no\r\n"
        "Connection: close\r\n{}\r\n",
        kSafety);
}

}  // namespace terrane::web
