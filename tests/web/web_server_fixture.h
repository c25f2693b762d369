// A web server whose answers a test controls.
#pragma once

#include "tests/web/web_fixture.h"

namespace terrane::web {

// "/" is a page with a tag, "/api/block" is answered later by the test, "/large.bin" exceeds the buffers of
// sockets, other names return their own text.
class WebServerTest : public testing::Test {
  protected:
    WebServer& start(const WebLimits& limits = {}, const WebAddress& address = {}) {
        auto server = WebServer::open(
            context_, address,
            [this](const Route& route, Reply reply) { return answer(route, std::move(reply)); }, hub_,
            limits);
        if (!server) throw std::runtime_error(server.error().message);
        server_ = std::move(*server);
        return *server_;
    }
    Cancel answer(const Route& route, Reply reply) {
        if (std::holds_alternative<BlockAt>(route)) {
            replies_.push_back(std::move(reply));
            return [this] { ++cancelled_; };
        }
        const auto* page = std::get_if<PageFile>(&route);
        if (page && page->name == "index.html") {
            Response found = textResponse(200, "the page");
            found.tag = "t1";
            reply(found);
        } else if (page && page->name == "large.bin") {
            reply({.body = large_});
        } else {
            reply(textResponse(page ? 200 : 404, page ? page->name : "none"));
        }
        return nullptr;
    }
    Browser browser(const std::string& address = "127.0.0.1", int receiveBytes = 0) {
        return Browser(server_->port(), address, receiveBytes);
    }
    template <class Condition>
    bool runUntil(Condition isSo) {
        return runContextUntil(context_, isSo);
    }
    void runShortly() {
        for (int k = 0; k < 3; ++k) {
            context_.restart();
            context_.run_for(std::chrono::milliseconds(2));
        }
    }
    // The next answer; status 0 if none arrives.
    Received next(Browser& from, bool hasBody = true) {
        std::optional<Received> found;
        EXPECT_TRUE(runUntil([&] { return (found = from.take(hasBody)).has_value() || from.isClosed(); }));
        return found.value_or(Received{});
    }
    Received answerTo(const std::string& text, bool hasBody = true) {
        Browser one = browser();
        one.send(text);
        return next(one, hasBody);
    }
    bool isClosedSoon(Browser& one) {
        return runUntil([&] { return one.isClosed(); });
    }
    bool isClosedByTicks(Browser& one) {
        return runUntil([&] {
            server_->tick();
            return one.isClosed();
        });
    }
    std::size_t connectionCount() { return server_->statistics().connections; }

    boost::asio::io_context context_;
    EventHub hub_;
    std::vector<Reply> replies_;
    int cancelled_ = 0;
    std::shared_ptr<const std::string> large_ = std::make_shared<const std::string>(16 << 20, 'x');
    std::unique_ptr<WebServer> server_;
};

}  // namespace terrane::web
