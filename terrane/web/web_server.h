// An HTTP server for browsers, with limits that protect it from any client. A function provides the
// responses. It is used on one thread, which runs the context; a game server ticks on the same thread.
//
// HTTP/1.1 without TLS (a proxy can add it), only GET and HEAD, no request bodies. A connection costs at most
// about 20 KB plus a response shared with others; slow and idle connections are closed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/web/event_hub.h"
#include "terrane/web/route.h"

namespace terrane::web {

// An HTTP response. All are plain values.
struct Response {
    int status = 200;
    std::string_view type = "text/plain; charset=utf-8";  // refers to a constant
    std::shared_ptr<const std::string> body = nullptr;    // null: empty
    std::string tag = {};                                 // ETag; empty: none
    // Seconds for which the browser may cache; 0: it revalidates each time with the tag.
    int maxAge = 0;
    int retryAfter = 0;  // seconds; 0: no header
};

// Returns the head of an HTTP/1.1 response: status line, fields, empty line. `keepsOpen`: another request may
// follow.
std::string headerOf(const Response& answer, bool keepsOpen);
// Returns the head of a stream of server-sent events.
std::string streamHeader();

inline Response textResponse(int status, std::string text) {
    return {.status = status, .body = std::make_shared<const std::string>(std::move(text))};
}
// Returns a response for a temporary error, which makes the client retry after a second.
inline Response busyResponse(int status, std::string text) {
    Response answer = textResponse(status, std::move(text));
    answer.retryAfter = 1;
    return answer;
}
inline Response jsonResponse(std::string text) {
    return {.type = "application/json", .body = std::make_shared<const std::string>(std::move(text))};
}

}  // namespace terrane::web

namespace boost::asio {
class io_context;
}

namespace terrane::web {

struct WebAddress {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;  // 0: any free port
    // Names of the server besides localhost and its address (host_check.h): requests for other hosts and from
    // pages of other sites are refused.
    std::vector<std::string> hosts = {};
};

struct WebLimits {
    std::size_t connections = 1024;
    // Per address, except for loopback addresses, where a proxy makes many connections.
    std::size_t connectionsPerAddress = 64;
    std::size_t responsesPerAddress = 16;                 // being prepared at a time, per address as above
    double requestsPerSecond = 200, requestBurst = 1000;  // per address, as above
    std::size_t headerBytes = 8192;
    std::size_t unsentEventBytes = 256 << 10;  // per listener
    std::chrono::seconds headerTimeout{10};    // from the first byte, or from connecting
    std::chrono::seconds idleTimeout{60};      // between requests
    std::chrono::seconds sendTimeout{30};      // per answer
};

struct WebStatistics {
    std::size_t connections = 0, listeners = 0;
    std::uint64_t opened = 0, requests = 0, refused = 0;  // refused: over a limit
    std::uint64_t answers2xx = 0, answers3xx = 0, answers4xx = 0, answers5xx = 0;
    std::uint64_t bytesSent = 0;
};

// Calls `reply` once, immediately or later, on the web's thread. The returned function, which may be empty,
// is called if the client no longer waits.
using Reply = std::function<void(Response)>;
using Cancel = std::function<void()>;
using RouteHandler = std::function<Cancel(const Route& route, Reply reply)>;

class WebServer {
  public:
    // Starts to listen. The context, the function and the hub outlive this.
    [[nodiscard]] static base::Result<std::unique_ptr<WebServer>> open(boost::asio::io_context& context,
                                                                       const WebAddress& address,
                                                                       RouteHandler answer, EventHub& events,
                                                                       const WebLimits& limits = {});
    ~WebServer();  // closes all connections

    std::uint16_t port() const;
    const WebStatistics& statistics() const;
    // Closes slow and idle connections. Call about once per second.
    void tick();

  private:
    struct Impl;
    explicit WebServer(std::shared_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;  // the context's last handlers may outlive this
};

}  // namespace terrane::web
