// The state of a WebServer, shared by web_server.cpp (connections and their limits) and web_requests.cpp
// (requests and answers).
#pragma once

#include <boost/asio/io_context.hpp>
#include <map>
#include <memory>
#include <string>

#include "terrane/web/host_check.h"
#include "terrane/web/web_connection_internal.h"
#include "terrane/web/web_server.h"

namespace terrane::web {

struct WebServer::Impl : std::enable_shared_from_this<WebServer::Impl> {
    Impl(boost::asio::io_context& io, RouteHandler answerRoute, EventHub& eventHub,
         const WebLimits& webLimits)
        : acceptor(io), answer(std::move(answerRoute)), events(eventHub), limits(webLimits) {}

    base::Result<void> listen(const WebAddress& address);
    void accept();
    void add(Tcp::socket socket);
    void makeRoom();
    void read(const ConnectionPtr& connection);
    void onRead(const ConnectionPtr& connection, const SocketError& error, std::size_t bytes);
    void handle(const ConnectionPtr& connection, const RequestParser& parser);
    bool mayAsk(Connection& connection);
    void watch(const ConnectionPtr& connection);
    void reply(const ConnectionPtr& connection, Response answer);
    void stream(const ConnectionPtr& connection);
    bool addEvent(const ConnectionPtr& connection, const EventText& event);
    void sendEvents(const ConnectionPtr& connection);
    void close(const ConnectionPtr& connection);
    bool isSlow(Connection& connection, Time time) const;
    void closeSlow();
    static void enter(Connection& connection, Stage stage) {
        connection.use->answering -= connection.stage == Stage::Answering;
        connection.use->answering += stage == Stage::Answering;
        connection.stage = stage;
        connection.since = std::chrono::steady_clock::now();
    }

    Tcp::acceptor acceptor;
    OwnHosts own;
    RouteHandler answer;
    EventHub& events;
    WebLimits limits;
    WebStatistics statistics;
    std::map<std::uint64_t, ConnectionPtr> connections;
    std::map<std::string, AddressUsage> addresses;
    std::uint64_t lastId = 0;
    bool isAccepting = false;
};

}  // namespace terrane::web
