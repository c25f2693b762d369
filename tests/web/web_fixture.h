// A web server and browsers on one thread: local sockets, and bytes written by tests.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/web/web_server.h"
#include "tests/base/wait_until.h"

namespace terrane::web {

// A received response.
struct Received {
    int status = 0;
    std::string header, body;

    // The value of a header field; empty if missing.
    std::string field(const std::string& name) const {
        const std::size_t at = header.find("\r\n" + name + ": ");
        if (at == std::string::npos) return {};
        const std::size_t begin = at + name.size() + 4;
        return header.substr(begin, header.find("\r\n", begin) - begin);
    }
};

// Sends arbitrary bytes. Only connecting blocks.
class Browser {
  public:
    explicit Browser(std::uint16_t port, const std::string& address = "127.0.0.1", int receiveBytes = 0)
        : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        if (receiveBytes > 0)
            ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receiveBytes, sizeof(receiveBytes));
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(port);
        ::inet_pton(AF_INET, address.c_str(), &to.sin_addr);
        if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) != 0)
            throw std::runtime_error("cannot connect");
    }
    ~Browser() { close(); }
    Browser(Browser&& other) noexcept
        : socket_(std::exchange(other.socket_, -1)),
          text_(std::move(other.text_)),
          isClosed_(other.isClosed_) {}
    Browser& operator=(Browser&&) = delete;

    void send(std::string_view text) { (void)::send(socket_, text.data(), text.size(), MSG_NOSIGNAL); }
    void get(const std::string& target, const std::string& fields = {}) {
        send("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n");
    }
    void close() {
        if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    }

    // Everything received and not taken yet.
    const std::string& text() {
        read();
        return text_;
    }
    bool isClosed() {
        read();
        return isClosed_;
    }
    // The next complete response. `hasBody`: false after HEAD.
    std::optional<Received> take(bool hasBody = true) {
        read();
        const std::size_t end = text_.find("\r\n\r\n");
        if (end == std::string::npos) return std::nullopt;
        Received answer{std::atoi(text_.c_str() + 9), text_.substr(0, end + 4), {}};
        const std::string length = answer.field("Content-Length");
        const std::size_t size = hasBody && !length.empty() ? std::stoul(length) : 0;
        if (text_.size() < end + 4 + size) return std::nullopt;
        answer.body = text_.substr(end + 4, size);
        text_.erase(0, end + 4 + size);
        return answer;
    }

  private:
    void read() {
        std::vector<char> buffer(65536);
        while (!isClosed_ && socket_ >= 0) {
            const ssize_t count = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
            if (count > 0) text_.append(buffer.data(), static_cast<std::size_t>(count));
            if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
            if (count <= 0) isClosed_ = true;
        }
    }

    int socket_;
    std::string text_;
    bool isClosed_ = false;
};

// Runs the context until the condition holds; false on timeout.
template <class Condition>
bool runContextUntil(boost::asio::io_context& context, Condition isSo) {
    const auto end = std::chrono::steady_clock::now() + base::kHangs;
    while (std::chrono::steady_clock::now() < end) {
        context.restart();
        context.run_for(std::chrono::milliseconds(2));
        if (isSo()) return true;
    }
    return false;
}

}  // namespace terrane::web
