#include "terrane/net/client/client_socket.h"

#include <array>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <charconv>
#include <utility>

#include "terrane/net/wire/message_codec.h"
#include "terrane/net/wire/security.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using SocketError = boost::system::error_code;

constexpr std::size_t kClientReadBytes = 16384;

}  // namespace

base::Result<ServerAddress> serverAddress(const std::string& text) {
    const auto wrong = [&] {
        return base::fail(base::ErrorCode::BadInput, "\"{}\" is no server: expected HOST or HOST:PORT", text);
    };
    ServerAddress address;
    std::string_view port;
    const bool isBracketed = text.starts_with('[');
    const std::size_t end = isBracketed ? text.find(']') : text.rfind(':');
    if (isBracketed) {
        if (end == std::string::npos) return wrong();
        address.host = text.substr(1, end - 1);
        const std::string_view rest = std::string_view(text).substr(end + 1);
        if (!rest.empty() && rest.front() != ':') return wrong();
        if (!rest.empty()) port = rest.substr(1);
        if (!rest.empty() && port.empty()) return wrong();
    } else {
        address.host = text.substr(0, end);
        if (address.host.find(':') != std::string::npos) {  // an IPv6 address without a port
            address.host = text;
        } else if (end != std::string::npos) {
            port = std::string_view(text).substr(end + 1);
            if (port.empty()) return wrong();
        }
    }
    if (address.host.empty() || address.host.size() > 255) return wrong();
    if (port.empty()) return address;
    const auto [parsed, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
    if (error != std::errc() || parsed != port.data() + port.size() || address.port == 0) return wrong();
    return address;
}

std::string textOf(const ServerAddress& address) {
    const bool isV6 = address.host.find(':') != std::string::npos;
    return fmt::format("{}{}{}:{}", isV6 ? "[" : "", address.host, isV6 ? "]" : "", address.port);
}

struct ClientSocket::Impl : std::enable_shared_from_this<ClientSocket::Impl> {
    Impl(asio::io_context& io, SocketEvents socketEvents)
        : events(std::move(socketEvents)), tls(clientContext()), resolver(io), stream(io, tls) {}

    void connect(const ServerAddress& address);
    void handshake();
    void read();
    void takeFrames(std::size_t bytes);
    void write();
    void close();
    void fail(const std::string& reason);

    SocketEvents events;
    asio::ssl::context tls;
    Tcp::resolver resolver;
    asio::ssl::stream<Tcp::socket> stream;
    FrameReader reader{kMaxServerMessage};
    std::array<std::byte, kClientReadBytes> input;
    Bytes waiting, sending;
    bool isOpen = false, isClosed = false;
};

void ClientSocket::Impl::connect(const ServerAddress& address) {
    const auto self = shared_from_this();
    const auto connected = [self](const SocketError& error, const Tcp::endpoint&) {
        if (error) return self->fail(error.message());
        SocketError ignored;
        self->stream.next_layer().set_option(Tcp::no_delay(true), ignored);
        self->handshake();
    };
    const auto resolved = [self, connected](const SocketError& error,
                                            const Tcp::resolver::results_type& found) {
        if (error) return self->fail(error.message());
        asio::async_connect(self->stream.next_layer(), found, connected);
    };
    resolver.async_resolve(address.host, std::to_string(address.port), resolved);
}

void ClientSocket::Impl::handshake() {
    stream.async_handshake(asio::ssl::stream_base::client, [self = shared_from_this()](
                                                               const SocketError& error) {
        if (error) return self->fail("no TLS 1.3: " + error.message());
        if (self->isClosed) return;
        self->isOpen = true;
        self->read();
        self->events.opened(channelOf(self->stream.native_handle()), peerKey(self->stream.native_handle()));
        self->write();
    });
}

void ClientSocket::Impl::read() {
    stream.async_read_some(asio::buffer(input),
                           [self = shared_from_this()](const SocketError& error, std::size_t bytes) {
                               if (error) return self->fail("the connection ended: " + error.message());
                               self->takeFrames(bytes);
                               if (!self->isClosed) self->read();
                           });
}

void ClientSocket::Impl::takeFrames(std::size_t bytes) {
    reader.add(ByteView(input).first(bytes));
    while (!isClosed) {
        const auto frame = reader.next();
        if (!frame) return fail("the server sent " + frame.error().message);
        if (!*frame) return;
        events.message(**frame);
    }
}

void ClientSocket::Impl::write() {
    if (!isOpen || isClosed || !sending.empty() || waiting.empty()) return;
    sending.swap(waiting);
    asio::async_write(stream, asio::buffer(sending),
                      [self = shared_from_this()](const SocketError& error, std::size_t) {
                          self->sending.clear();
                          if (error) return self->fail("the connection ended: " + error.message());
                          self->write();
                      });
}

void ClientSocket::Impl::close() {
    if (isClosed) return;
    isClosed = true;
    SocketError ignored;
    resolver.cancel();
    stream.next_layer().shutdown(Tcp::socket::shutdown_both, ignored);
    stream.next_layer().close(ignored);
}

void ClientSocket::Impl::fail(const std::string& reason) {
    if (isClosed) return;
    close();
    events.closed(reason);
}

ClientSocket::ClientSocket(asio::io_context& context, const ServerAddress& address, SocketEvents events)
    : impl_(std::make_shared<Impl>(context, std::move(events))) {
    impl_->connect(address);
}

ClientSocket::~ClientSocket() {
    if (impl_) impl_->close();
}
ClientSocket::ClientSocket(ClientSocket&&) noexcept = default;
ClientSocket& ClientSocket::operator=(ClientSocket&& other) noexcept {
    if (this != &other) {
        if (impl_) impl_->close();
        impl_ = std::move(other.impl_);
    }
    return *this;
}

void ClientSocket::send(ByteView message) {
    appendFrame(impl_->waiting, message);
    impl_->write();
}

void ClientSocket::close() {
    impl_->close();
}

std::uint64_t ClientSocket::receivedBytes() const {
    return impl_->isOpen ? BIO_number_read(SSL_get_rbio(impl_->stream.native_handle())) : 0;
}

std::uint64_t ClientSocket::sentBytes() const {
    return impl_->isOpen ? BIO_number_written(SSL_get_wbio(impl_->stream.native_handle())) : 0;
}

}  // namespace terrane::net
