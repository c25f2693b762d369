// Reads requests, sends answers and events.
#include <algorithm>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/web/web_server_internal.h"

namespace terrane::web {

namespace asio = boost::asio;
namespace http = boost::beast::http;

void WebServer::Impl::read(const ConnectionPtr& connection) {
    enter(*connection, Stage::Idle);
    connection->begun.reset();
    asio::async_read_until(
        connection->socket, connection->buffer, "\r\n\r\n",
        [this, self = shared_from_this(), connection](const SocketError& error, std::size_t bytes) {
            onRead(connection, error, bytes);
        });
}

// The parser gets the header as a whole. If it read by itself, its limit would only count unparsed bytes, so
// any number of short fields would pass.
void WebServer::Impl::onRead(const ConnectionPtr& connection, const SocketError& error, std::size_t bytes) {
    if (connection->stage == Stage::Closed) return;
    ++connection->request;
    connection->keepsOpen = false;
    connection->isHead = false;
    connection->knownTag.clear();
    if (error == asio::error::not_found)
        return reply(connection, textResponse(431, "the header is too large\n"));
    if (error) return close(connection);
    RequestParser parser;
    parser.header_limit(static_cast<std::uint32_t>(bytes + 1));
    parser.body_limit(0);
    SocketError wrong;
    parser.put(asio::const_buffer(connection->buffer.data().data(), bytes), wrong);
    connection->buffer.consume(bytes);
    if (wrong == http::error::body_limit)
        return reply(connection, textResponse(413, "requests have no body here\n"));
    if (wrong || !parser.is_header_done()) return reply(connection, textResponse(400, "not a request\n"));
    handle(connection, parser);
}

bool WebServer::Impl::mayAsk(Connection& connection) {
    AddressUsage& use = *connection.use;
    use.seen = std::chrono::steady_clock::now();
    return !connection.isLimited || use.requests.take(1, use.seen);
}

namespace {

// Status and text for a request that names another host, or comes from a page of another site. Every browser
// sends Host.
std::optional<std::pair<int, std::string_view>> refusalOfHost(const http::request<http::empty_body>& request,
                                                              const OwnHosts& own) {
    const auto textOf = [&](http::field field) {
        const auto found = request.find(field);
        return found == request.end() ? std::string_view()
                                      : std::string_view(found->value().data(), found->value().size());
    };
    const std::string_view host = textOf(http::field::host);
    if (request.count(http::field::host) > 1) return std::pair(400, "one request has one host\n");
    if (request.count(http::field::host) == 1 && !isOwnHost(host, own))
        return std::pair(421, "this host is no name of the map: its server allows names with --map-host\n");
    if (request.count(http::field::origin) > 0 && !isOwnOrigin(textOf(http::field::origin), host, own))
        return std::pair(403, "pages of other sites get no answers\n");
    return std::nullopt;
}

}  // namespace

void WebServer::Impl::handle(const ConnectionPtr& connection, const RequestParser& parser) {
    const auto& request = parser.get();
    ++statistics.requests;
    const bool hasBody = !parser.is_done();
    // HTTP/1.0 would need an explicit keep-alive header.
    connection->keepsOpen = request.version() >= 11 && request.keep_alive() && !hasBody;
    connection->isHead = request.method() == http::verb::head;
    if (const auto tag = request.find(http::field::if_none_match); tag != request.end())
        connection->knownTag = std::string(tag->value());
    if (!mayAsk(*connection)) {
        ++statistics.refused;
        return reply(connection, busyResponse(429, "too many requests\n"));
    }
    if (hasBody) return reply(connection, textResponse(413, "requests have no body here\n"));
    if (const auto refusal = refusalOfHost(request, own))
        return reply(connection, textResponse(refusal->first, std::string(refusal->second)));
    if (request.method() != http::verb::get && !connection->isHead)
        return reply(connection, textResponse(405, "only GET and HEAD are allowed\n"));
    const auto target = parseTarget({request.target().data(), request.target().size()});
    if (!target) return reply(connection, textResponse(400, "not a path\n"));
    const Route route = routeOf(*target);
    if (const auto* bad = std::get_if<BadRequest>(&route))
        return reply(connection, textResponse(400, bad->why + "\n"));
    if (std::holds_alternative<NotFound>(route)) return reply(connection, textResponse(404, "not found\n"));
    if (std::holds_alternative<EventStream>(route)) {
        if (!connection->isHead) return stream(connection);
        return reply(connection, {.type = "text/event-stream", .body = nullptr});
    }
    if (connection->isLimited && connection->use->answering >= limits.responsesPerAddress) {
        ++statistics.refused;
        return reply(connection, busyResponse(503, "too many requests at a time\n"));
    }
    enter(*connection, Stage::Answering);
    const std::uint64_t number = connection->request;
    Cancel cancel = answer(route, [this, weak = std::weak_ptr(connection), number](Response found) {
        const ConnectionPtr waiting = weak.lock();
        if (waiting && waiting->stage == Stage::Answering && waiting->request == number)
            reply(waiting, std::move(found));
    });
    if (connection->stage != Stage::Answering || connection->request != number) return;
    connection->cancel = std::move(cancel);
    watch(connection);
}

// A browser that no longer needs an answer closes the connection.
void WebServer::Impl::watch(const ConnectionPtr& connection) {
    const std::uint64_t number = connection->request;
    connection->socket.async_wait(Tcp::socket::wait_read, [this, self = shared_from_this(), connection,
                                                           number](const SocketError& error) {
        const bool waits = connection->stage == Stage::Answering || connection->stage == Stage::Streaming;
        if (!waits || connection->request != number) return;
        SocketError ignored;
        if (error || connection->socket.available(ignored) == 0) close(connection);
    });
}

void WebServer::Impl::reply(const ConnectionPtr& connection, Response found) {
    connection->cancel = nullptr;
    SocketError ignored;
    connection->socket.cancel(ignored);  // ends watch(), so that consecutive requests leave none behind
    if (found.status == 200 && !found.tag.empty() &&
        connection->knownTag.find('"' + found.tag + '"') != std::string::npos) {
        found.status = 304;
        found.body = nullptr;
    }
    std::uint64_t* const counts[] = {&statistics.answers2xx, &statistics.answers3xx, &statistics.answers4xx,
                                     &statistics.answers5xx};
    ++*counts[std::clamp(found.status / 100 - 2, 0, 3)];
    enter(*connection, Stage::Sending);
    connection->header = headerOf(found, connection->keepsOpen);
    connection->body = connection->isHead ? nullptr : found.body;
    std::vector<asio::const_buffer> buffers{asio::buffer(connection->header)};
    if (connection->body) buffers.push_back(asio::buffer(*connection->body));
    asio::async_write(
        connection->socket, buffers,
        [this, self = shared_from_this(), connection](const SocketError& error, std::size_t bytes) {
            statistics.bytesSent += bytes;
            connection->body = nullptr;
            if (connection->stage == Stage::Closed) return;
            if (error || !connection->keepsOpen) return close(connection);
            read(connection);
        });
}

void WebServer::Impl::stream(const ConnectionPtr& connection) {
    enter(*connection, Stage::Streaming);
    ++statistics.listeners;
    ++statistics.answers2xx;
    addEvent(connection, std::make_shared<const std::string>(streamHeader()));
    events.add([this, weak = std::weak_ptr(connection)](const EventText& event) {
        const ConnectionPtr listener = weak.lock();
        return listener && addEvent(listener, event);
    });
    watch(connection);
}

bool WebServer::Impl::addEvent(const ConnectionPtr& connection, const EventText& event) {
    if (connection->stage != Stage::Streaming) return false;
    const bool isBehind = connection->eventBytes > 0;  // a single event above the limit is sent anyway
    if (isBehind && connection->eventBytes + event->size() > limits.unsentEventBytes) {
        ++statistics.refused;
        close(connection);
        return false;
    }
    connection->events.push_back(event);
    connection->eventBytes += event->size();
    if (!connection->isSending) sendEvents(connection);
    return true;
}

void WebServer::Impl::sendEvents(const ConnectionPtr& connection) {
    connection->isSending = true;
    asio::async_write(
        connection->socket, asio::buffer(*connection->events.front()),
        [this, self = shared_from_this(), connection](const SocketError& error, std::size_t bytes) {
            statistics.bytesSent += bytes;
            connection->isSending = false;
            if (connection->stage == Stage::Closed) return;
            if (error) return close(connection);
            connection->eventBytes -= connection->events.front()->size();
            connection->events.pop_front();
            if (!connection->events.empty()) sendEvents(connection);
        });
}

}  // namespace terrane::web
