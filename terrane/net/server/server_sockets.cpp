#include "terrane/net/server/server_sockets.h"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <map>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/tcp.h"
#include "terrane/net/server/server.h"
#include "terrane/net/wire/security.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using SocketError = boost::system::error_code;

constexpr std::size_t kServerReadBytes = 4096;
// Time for a refused client to read the reason.
constexpr std::chrono::seconds kClosingTime{2};

}  // namespace

struct ServerConnection {
    ServerConnection(ConnectionId number, Tcp::socket opened)
        : id(number), socket(std::move(opened)), openedAt(std::chrono::steady_clock::now()) {}

    ConnectionId id;
    Tcp::socket socket;
    ClientAddress address;
    Time openedAt;
    std::optional<asio::ssl::stream<Tcp::socket&>> stream;  // once the first bytes arrived
    FrameReader reader{kMaxClientMessage};
    std::array<std::byte, kServerReadBytes> input;
    Bytes sending;
    bool isOpened = false;  // onOpened() was called
    std::optional<Time> closingSince;
};
using ConnectionPtr = std::shared_ptr<ServerConnection>;

namespace {

ClientAddress addressOf(const Tcp::socket& socket) {
    SocketError error;
    const auto endpoint = socket.remote_endpoint(error);
    if (error) return {"somewhere", "somewhere", false};
    const asio::ip::address address = base::addressOf(endpoint);
    return {address.to_string(), base::networkOf(address), address.is_loopback()};
}

}  // namespace

struct ServerSockets::Impl : std::enable_shared_from_this<ServerSockets::Impl> {
    Impl(asio::io_context& io, ServerState& state, asio::ssl::context tlsContext)
        : server(state), tls(std::move(tlsContext)), acceptor(io) {}

    base::Result<void> listen(const ListenAddress& address);
    void accept();
    void addConnection(Tcp::socket socket);
    void makeRoom();
    void waitForClient(const ConnectionPtr& connection);
    void handshake(const ConnectionPtr& connection);
    void read(const ConnectionPtr& connection);
    void takeFrames(const ConnectionPtr& connection, std::size_t bytes);
    void flush(const ConnectionPtr& connection);
    void send(const ConnectionPtr& connection);
    void close(const ConnectionPtr& connection);
    bool isOpen(const ConnectionPtr& connection) const { return connections.contains(connection->id); }
    bool isAt(const ServerConnection& connection, ServerClient::Stage stage) const;
    bool plays(const ServerConnection& connection) const {
        return isAt(connection, ServerClient::Stage::Playing);
    }
    bool isSentAway(const ServerConnection& connection) const {
        return isAt(connection, ServerClient::Stage::Closed);
    }

    ServerState& server;
    asio::ssl::context tls;
    Tcp::acceptor acceptor;
    std::map<ConnectionId, ConnectionPtr> connections;
    ConnectionId lastId = 0;
    bool isAccepting = false;
};

base::Result<void> ServerSockets::Impl::listen(const ListenAddress& address) {
    TERRANE_TRY(base::listenAt(acceptor, address.address, address.port));
    SocketError error;
    acceptor.non_blocking(true, error);
    if (error)
        return base::fail(base::ErrorCode::Io, "{} port {}: cannot listen: {}", address.address, address.port,
                          error.message());
    accept();
    return {};
}

void ServerSockets::Impl::accept() {
    isAccepting = true;
    acceptor.async_accept([this, self = shared_from_this()](const SocketError& error, Tcp::socket socket) {
        isAccepting = false;
        if (!acceptor.is_open()) return;  // stopListening() came between
        if (error) return;                // e.g. out of file descriptors: the next tick tries again
        addConnection(std::move(socket));
        accept();
    });
}

bool ServerSockets::Impl::isAt(const ServerConnection& connection, ServerClient::Stage stage) const {
    const auto found = server.clients.all.find(connection.id);
    return found != server.clients.all.end() && found->second.stage == stage;
}

// Closes the oldest connection of the address with the most pending ones.
void ServerSockets::Impl::makeRoom() {
    std::map<std::string_view, std::vector<ConnectionPtr>> pending;
    std::size_t count = 0;
    for (const auto& [id, connection] : connections) {
        if (plays(*connection)) continue;
        pending[connection->address.network].push_back(connection);
        ++count;
    }
    if (count < kMaxPendingConnections) return;
    const auto most =
        std::ranges::max_element(pending, {}, [](const auto& entry) { return entry.second.size(); });
    close(ConnectionPtr(most->second.front()));
}

void ServerSockets::Impl::addConnection(Tcp::socket socket) {
    makeRoom();
    SocketError ignored;
    socket.set_option(Tcp::no_delay(true), ignored);
    const auto connection = std::make_shared<ServerConnection>(++lastId, std::move(socket));
    connection->address = addressOf(connection->socket);
    connections[connection->id] = connection;
    waitForClient(connection);
}

// A connection that sends nothing costs only a socket.
void ServerSockets::Impl::waitForClient(const ConnectionPtr& connection) {
    connection->socket.async_wait(Tcp::socket::wait_read,
                                  [this, self = shared_from_this(), connection](const SocketError& error) {
                                      if (error) return close(connection);
                                      if (isOpen(connection)) handshake(connection);
                                  });
}

void ServerSockets::Impl::handshake(const ConnectionPtr& connection) {
    connection->stream.emplace(connection->socket, tls);
    connection->stream->async_handshake(
        asio::ssl::stream_base::server,
        [this, self = shared_from_this(), connection](const SocketError& error) {
            if (error || !isOpen(connection)) return close(connection);
            connection->isOpened = true;
            onOpened(server, connection->id, channelOf(connection->stream->native_handle()),
                     connection->address, std::chrono::steady_clock::now());
            read(connection);
        });
}

void ServerSockets::Impl::read(const ConnectionPtr& connection) {
    connection->stream->async_read_some(
        asio::buffer(connection->input),
        [this, self = shared_from_this(), connection](const SocketError& error, std::size_t bytes) {
            if (error) return close(connection);
            if (isOpen(connection) && !isSentAway(*connection)) takeFrames(connection, bytes);
            if (isOpen(connection)) read(connection);
        });
}

void ServerSockets::Impl::takeFrames(const ConnectionPtr& connection, std::size_t bytes) {
    const Time now = std::chrono::steady_clock::now();
    connection->reader.add(ByteView(connection->input).first(bytes));
    while (true) {
        const auto frame = connection->reader.next();
        if (!frame) {
            onMalformedMessage(server, connection->id, frame.error().message, now);
            break;
        }
        if (!*frame) break;
        onMessage(server, connection->id, **frame, now);
    }
    // Login answers are sent without waiting for the tick.
    if (!plays(*connection)) flush(connection);
}

void ServerSockets::Impl::flush(const ConnectionPtr& connection) {
    const auto found = server.clients.all.find(connection->id);
    if (found == server.clients.all.end() || !connection->sending.empty()) return;
    ServerClient& client = found->second;
    if (!client.outgoing.empty()) {
        connection->sending.swap(client.outgoing);
        client.unsent = connection->sending.size();
        return send(connection);
    }
    // Further input is read and dropped until the client closes: if this side closed at once, the system
    // would reset the connection and the client might never read the reason.
    if (client.stage != ServerClient::Stage::Closed) return;
    SocketError ignored;
    connection->socket.shutdown(Tcp::socket::shutdown_send, ignored);
}

void ServerSockets::Impl::send(const ConnectionPtr& connection) {
    asio::async_write(*connection->stream, asio::buffer(connection->sending),
                      [this, self = shared_from_this(), connection](const SocketError& error, std::size_t) {
                          connection->sending.clear();
                          if (error) return close(connection);
                          if (!isOpen(connection)) return;
                          if (const auto found = server.clients.all.find(connection->id);
                              found != server.clients.all.end())
                              found->second.unsent = 0;
                          flush(connection);
                      });
}

void ServerSockets::Impl::close(const ConnectionPtr& connection) {
    if (connections.erase(connection->id) == 0) return;
    SocketError ignored;
    connection->socket.shutdown(Tcp::socket::shutdown_both, ignored);
    connection->socket.close(ignored);
    if (connection->isOpened) onClosed(server, connection->id, std::chrono::steady_clock::now());
}

ServerSockets::ServerSockets(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}

ServerSockets::~ServerSockets() {
    stopListening();
    while (!impl_->connections.empty()) impl_->close(ConnectionPtr(impl_->connections.begin()->second));
}

base::Result<std::unique_ptr<ServerSockets>> ServerSockets::open(asio::io_context& context,
                                                                 ServerState& server,
                                                                 const ListenAddress& address,
                                                                 const std::filesystem::path& keyFile) {
    auto tls = TERRANE_TRY(serverContext(keyFile));
    auto impl = std::make_shared<Impl>(context, server, std::move(tls));
    TERRANE_TRY(impl->listen(address));
    return std::unique_ptr<ServerSockets>(new ServerSockets(std::move(impl)));
}

std::uint16_t ServerSockets::port() const {
    SocketError error;
    return impl_->acceptor.local_endpoint(error).port();
}

std::string ServerSockets::key() const {
    return ownKey(impl_->tls.native_handle());
}

void ServerSockets::flush() {
    const Time now = std::chrono::steady_clock::now();
    std::vector<ConnectionPtr> all;
    for (const auto& [id, connection] : impl_->connections) all.push_back(connection);
    for (const ConnectionPtr& connection : all) {
        const auto found = impl_->server.clients.all.find(connection->id);
        const bool isKnown = found != impl_->server.clients.all.end();
        const bool isClosed = isKnown && found->second.stage == ServerClient::Stage::Closed;
        if (isClosed && !connection->closingSince) connection->closingSince = now;
        const bool tookTooLong = !isKnown && now - connection->openedAt > impl_->server.settings.loginWithin;
        if (tookTooLong || (isClosed && now - *connection->closingSince > kClosingTime))
            impl_->close(connection);
        else
            impl_->flush(connection);
    }
    if (impl_->acceptor.is_open() && !impl_->isAccepting) impl_->accept();
}

void ServerSockets::stopListening() {
    SocketError ignored;
    impl_->acceptor.close(ignored);
}

std::size_t ServerSockets::connectionCount() const {
    return impl_->connections.size();
}

}  // namespace terrane::net
