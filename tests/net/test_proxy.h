// A proxy that simulates a network which delays, splits, stalls and cuts the stream between clients and a
// local server. On the thread that runs the context.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <deque>
#include <memory>
#include <vector>

namespace terrane::net {

class TestProxy {
  public:
    using Tcp = boost::asio::ip::tcp;
    using Error = boost::system::error_code;

    std::chrono::milliseconds delay{0};  // each way
    bool splits = false;                 // sends single bytes
    bool isStalled = false;              // reads nothing from either side

    TestProxy(boost::asio::io_context& context, std::uint16_t serverPort)
        : context_(context),
          server_(boost::asio::ip::make_address("127.0.0.1"), serverPort),
          acceptor_(context, Tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), 0)) {
        accept();
    }
    ~TestProxy() { cutAll(); }
    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
    // Cuts all open connections.
    void cutAll() {
        for (const auto& pair : pairs_)
            if (const auto open = pair.lock()) open->close();
        pairs_.clear();
    }

  private:
    struct Piece {
        std::chrono::steady_clock::time_point due;
        std::vector<char> bytes;
    };
    // One direction of a connection.
    struct Way {
        Way(Tcp::socket& source, Tcp::socket& target) : from(source), to(target) {}
        Tcp::socket& from;
        Tcp::socket& to;
        std::vector<char> input = std::vector<char>(16384);
        std::deque<Piece> pieces;
        bool isSending = false;
    };
    struct Pair {
        Pair(boost::asio::io_context& context, Tcp::socket socket)
            : client(std::move(socket)), server(context), up(client, server), down(server, client) {}
        void close() {
            Error ignored;
            client.close(ignored);
            server.close(ignored);
        }
        Tcp::socket client, server;
        Way up, down;
    };
    using PairPtr = std::shared_ptr<Pair>;

    void accept() {
        acceptor_.async_accept([this](const Error& error, Tcp::socket socket) {
            if (error) return;
            const auto pair = std::make_shared<Pair>(context_, std::move(socket));
            pairs_.push_back(pair);
            pair->server.async_connect(server_, [this, pair](const Error& failed) {
                if (failed) return pair->close();
                read(pair, pair->up);
                read(pair, pair->down);
            });
            accept();
        });
    }
    void read(const PairPtr& pair, Way& way) {
        if (isStalled) return later(std::chrono::milliseconds(20), [this, pair, &way] { read(pair, way); });
        way.from.async_read_some(
            boost::asio::buffer(way.input), [this, pair, &way](const Error& error, std::size_t bytes) {
                if (error) return pair->close();
                const auto end = way.input.begin() + static_cast<std::ptrdiff_t>(bytes);
                way.pieces.push_back({std::chrono::steady_clock::now() + delay, {way.input.begin(), end}});
                if (!way.isSending) send(pair, way);
                read(pair, way);
            });
    }
    void send(const PairPtr& pair, Way& way) {
        way.isSending = !way.pieces.empty();
        if (!way.isSending) return;
        const auto wait = way.pieces.front().due - std::chrono::steady_clock::now();
        if (wait > std::chrono::seconds(0)) return later(wait, [this, pair, &way] { send(pair, way); });
        Piece& piece = way.pieces.front();
        const std::size_t count = splits ? 1 : piece.bytes.size();
        boost::asio::async_write(way.to, boost::asio::buffer(piece.bytes.data(), count),
                                 [this, pair, &way, count](const Error& error, std::size_t) {
                                     if (error) return pair->close();
                                     auto& bytes = way.pieces.front().bytes;
                                     bytes.erase(bytes.begin(),
                                                 bytes.begin() + static_cast<std::ptrdiff_t>(count));
                                     if (bytes.empty()) way.pieces.pop_front();
                                     send(pair, way);
                                 });
    }
    template <class Use>
    void later(std::chrono::steady_clock::duration wait, Use use) {
        const auto timer = std::make_shared<boost::asio::steady_timer>(context_, wait);
        timer->async_wait([timer, use](const Error& error) {
            if (!error) use();
        });
    }

    boost::asio::io_context& context_;
    Tcp::endpoint server_;
    Tcp::acceptor acceptor_;
    std::vector<std::weak_ptr<Pair>> pairs_;
};

}  // namespace terrane::net
