// A browser's connection, used by web_server_internal.h. It is used on the web's thread.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/streambuf.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "terrane/base/timing.h"
#include "terrane/web/event_hub.h"
#include "terrane/web/web_server.h"

namespace terrane::web {

using Tcp = boost::asio::ip::tcp;
using SocketError = boost::system::error_code;
using Time = std::chrono::steady_clock::time_point;
using RequestParser = boost::beast::http::request_parser<boost::beast::http::empty_body>;

enum class Stage : std::uint8_t {
    Idle,       // between requests, or before the first
    Answering,  // the answer is being prepared
    Sending,
    Streaming,  // events
    Closed
};

// Usage by one address.
struct AddressUsage {
    std::size_t connections = 0, answering = 0;
    base::TokenBucket requests;
    Time seen = std::chrono::steady_clock::now();
};

struct Connection {
    Connection(std::uint64_t number, Tcp::socket opened, std::size_t headerBytes)
        : id(number), socket(std::move(opened)), buffer(headerBytes) {}

    std::uint64_t id;
    Tcp::socket socket;
    std::string address;          // for IPv6 the network
    AddressUsage* use = nullptr;  // shared by the address
    bool isLimited = true;        // limits per address apply
    Stage stage = Stage::Idle;
    Time since = std::chrono::steady_clock::now();  // start of this stage
    std::optional<Time> begun = {};                 // arrival of the first bytes of the request being read

    boost::asio::streambuf buffer;  // unprocessed input, at most the size of one header
    std::uint64_t request = 0;      // number of the request; late answers to earlier ones are dropped
    bool isHead = false, keepsOpen = true;
    std::string knownTag;
    Cancel cancel;

    std::string header;
    std::shared_ptr<const std::string> body;

    std::deque<EventText> events;  // the first is being sent if isSending
    std::size_t eventBytes = 0;
    bool isSending = false;
};
using ConnectionPtr = std::shared_ptr<Connection>;

}  // namespace terrane::web
