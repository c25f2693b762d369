// HTTP for browsers: connections with limits, from any client whatever it sends. Who answers is a function.
// On one thread, which runs the context; the server of a game runs its ticks on the same one.
//
// HTTP/1.1 without TLS (a proxy can add it), GET and HEAD alone, no bodies. A connection costs at most some
// 20 KB and an answer that is shared with others; those that are slow or idle are closed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "terrane/base/result.h"
#include "terrane/web/answer.h"
#include "terrane/web/event_hub.h"
#include "terrane/web/route.h"

namespace boost::asio {
class io_context;
}

namespace terrane::web {

struct WebAddress {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;  // 0: one that is free
};

struct WebLimits {
    std::size_t connections = 1024;
    // Of one address, but for this machine's own, from which a proxy asks for many.
    std::size_t connectionsOfAddress = 64;
    std::size_t answersOfAddress = 16;                      // that somebody looks for at a time, as above
    double requestsPerSecond = 200, requestsAtOnce = 1000;  // of one address, as above
    std::size_t headerBytes = 8192;
    std::size_t unsentEventBytes = 256 << 10;  // of a listener who does not read
    std::chrono::seconds headerWithin{10};     // from the first byte, or from opening
    std::chrono::seconds idleFor{60};          // between requests
    std::chrono::seconds sentWithin{30};       // each answer
};

struct WebStatistics {
    std::size_t connections = 0, listeners = 0;
    std::uint64_t opened = 0, requests = 0, refused = 0;  // refused: by a limit
    std::uint64_t answers2xx = 0, answers3xx = 0, answers4xx = 0, answers5xx = 0;
    std::uint64_t bytesSent = 0;
};

// Calls `reply` once, at once or later, on the web's thread. What it gives back is called where nobody waits
// any more; it may be empty.
using Reply = std::function<void(Answer)>;
using Cancel = std::function<void()>;
using AnswerRoute = std::function<Cancel(const Route& route, Reply reply)>;

class WebServer {
  public:
    // Listens from here on. The context, the function and the hub outlive this.
    [[nodiscard]] static base::Result<std::unique_ptr<WebServer>> open(boost::asio::io_context& context,
                                                                       const WebAddress& address,
                                                                       AnswerRoute answer, EventHub& events,
                                                                       const WebLimits& limits = {});
    ~WebServer();  // closes all

    std::uint16_t port() const;
    const WebStatistics& statistics() const;
    // Closes what is too slow or idle. About once a second.
    void tick();

  private:
    struct Impl;
    explicit WebServer(std::shared_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;  // what the context runs last may come after this
};

}  // namespace terrane::web
