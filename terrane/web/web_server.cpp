#include "terrane/web/web_server.h"

#include <fmt/format.h>
#include <boost/beast/http/status.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "terrane/base/tcp.h"
#include "terrane/web/web_server_internal.h"

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

std::string headerOf(const Response& answer, bool keepsOpen) {
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

namespace asio = boost::asio;

base::Result<void> WebServer::Impl::listen(const WebAddress& address) {
    TERRANE_TRY(base::listenAt(acceptor, address.address, address.port));
    own = {address.address, address.hosts};
    accept();
    return {};
}

void WebServer::Impl::accept() {
    isAccepting = true;
    acceptor.async_accept([this, self = shared_from_this()](const SocketError& error, Tcp::socket socket) {
        isAccepting = false;
        // Possibly out of file descriptors: the next tick tries again.
        if (error || !acceptor.is_open()) return;
        add(std::move(socket));
        accept();
    });
}

// Closes a connection: idle ones first, then listeners, the longest in its stage first.
void WebServer::Impl::makeRoom() {
    if (connections.size() < limits.connections) return;
    const auto rank = [](const Connection& connection) {
        return connection.stage == Stage::Idle ? 0 : connection.stage == Stage::Streaming ? 1 : 2;
    };
    const auto first = std::ranges::min_element(connections, {}, [&](const auto& entry) {
        return std::pair(rank(*entry.second), entry.second->since);
    });
    ++statistics.refused;
    close(ConnectionPtr(first->second));
}

void WebServer::Impl::add(Tcp::socket socket) {
    SocketError error;
    const Tcp::endpoint peer = socket.remote_endpoint(error);
    if (error) return;
    const auto connection = std::make_shared<Connection>(++lastId, std::move(socket), limits.headerBytes);
    const asio::ip::address address = base::addressOf(peer);
    connection->address = base::networkOf(address);
    connection->isLimited = !address.is_loopback();
    const AddressUsage unused{0, 0, {limits.requestsPerSecond, limits.requestBurst}};
    AddressUsage& use = addresses.try_emplace(connection->address, unused).first->second;
    if (connection->isLimited && use.connections >= limits.connectionsPerAddress) {
        ++statistics.refused;
        return;
    }
    makeRoom();
    connection->use = &use;
    connection->socket.set_option(Tcp::no_delay(true), error);
    ++use.connections;
    ++statistics.opened;
    connections[connection->id] = connection;
    read(connection);
}

void WebServer::Impl::close(const ConnectionPtr& connection) {
    if (connections.erase(connection->id) == 0) return;
    if (connection->stage == Stage::Streaming) --statistics.listeners;
    enter(*connection, Stage::Closed);
    --connection->use->connections;
    SocketError ignored;
    connection->socket.shutdown(Tcp::socket::shutdown_both, ignored);
    connection->socket.close(ignored);
    if (const Cancel cancel = std::exchange(connection->cancel, nullptr)) cancel();
}

bool WebServer::Impl::isSlow(Connection& connection, Time time) const {
    if (connection.stage == Stage::Sending) return time - connection.since > limits.sendTimeout;
    if (connection.stage != Stage::Idle) return false;
    // The deadline of the first request counts from connecting.
    if (!connection.begun && connection.request == 0) connection.begun = connection.since;
    if (!connection.begun && connection.buffer.size() > 0) connection.begun = time;
    if (connection.begun) return time - *connection.begun > limits.headerTimeout;
    return time - connection.since > limits.idleTimeout;
}

void WebServer::Impl::closeSlow() {
    const Time time = std::chrono::steady_clock::now();
    std::vector<ConnectionPtr> slow;
    for (const auto& [id, connection] : connections) {
        if (isSlow(*connection, time)) slow.push_back(connection);
    }
    for (const ConnectionPtr& connection : slow) close(connection);
    std::erase_if(addresses, [&](const auto& entry) {
        return entry.second.connections == 0 && time - entry.second.seen > std::chrono::seconds(60);
    });
}

base::Result<std::unique_ptr<WebServer>> WebServer::open(asio::io_context& context, const WebAddress& address,
                                                         RouteHandler answer, EventHub& events,
                                                         const WebLimits& limits) {
    auto impl = std::make_shared<Impl>(context, std::move(answer), events, limits);
    TERRANE_TRY(impl->listen(address));
    return std::unique_ptr<WebServer>(new WebServer(std::move(impl)));
}

WebServer::WebServer(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}

WebServer::~WebServer() {
    SocketError ignored;
    impl_->acceptor.close(ignored);
    impl_->answer = nullptr;  // its references may become invalid
    while (!impl_->connections.empty()) impl_->close(ConnectionPtr(impl_->connections.begin()->second));
}

std::uint16_t WebServer::port() const {
    SocketError error;
    return impl_->acceptor.local_endpoint(error).port();
}

const WebStatistics& WebServer::statistics() const {
    impl_->statistics.connections = impl_->connections.size();
    return impl_->statistics;
}

void WebServer::tick() {
    impl_->closeSlow();
    if (impl_->acceptor.is_open() && !impl_->isAccepting) impl_->accept();
}

}  // namespace terrane::web
