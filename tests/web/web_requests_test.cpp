// Tests of requests, answers and events: terrane/web/web_requests.cpp.
#include <gtest/gtest.h>

#include "tests/web/web_server_fixture.h"

namespace terrane::web {
namespace {

class WebRequestsTest : public WebServerTest {};

TEST_F(WebRequestsTest, AnswersGet) {
    start();
    const Received page = answerTo("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(page.body, "the page");
    EXPECT_EQ(page.field("Content-Length"), "8");
    EXPECT_EQ(page.field("ETag"), "\"t1\"");
    EXPECT_EQ(answerTo("GET /a.css?x=1 HTTP/1.1\r\n\r\n").body, "a.css") << "also without a host";
    EXPECT_EQ(server_->statistics().answers2xx, 2u);
    EXPECT_EQ(server_->statistics().requests, 2u);
}

// DNS rebinding: a page of evil.example asks this machine under its own name.
TEST_F(WebRequestsTest, OtherHostsAndPagesOfOtherSitesAreRefused) {
    start({}, {.hosts = {"map.example.org"}});
    const auto answer = [&](const std::string& fields, const std::string& path = "/") {
        return answerTo("GET " + path + " HTTP/1.1\r\n" + fields + "\r\n");
    };
    for (const char* path : {"/", "/api/edits", "/api/block?x=1&y=2", "/metrics"}) {
        const Received refused = answer("Host: evil.example\r\n", path);
        EXPECT_EQ(refused.status, 421) << path;
        EXPECT_EQ(refused.body, "this host is no name of the map: its server allows names with --map-host\n");
    }
    EXPECT_EQ(answer("Host: localhost\r\nOrigin: http://evil.example\r\n", "/api/edits").status, 403);
    EXPECT_EQ(answer("Host: localhost\r\nOrigin: null\r\n").status, 403);
    EXPECT_EQ(answer("Host: localhost\r\nHost: evil.example\r\n").status, 400);
    for (const char* host : {"localhost", "127.0.0.1:80", "map.example.org", "Map.Example.Org:443"})
        EXPECT_EQ(answer(std::string("Host: ") + host + "\r\n").body, "the page") << host;
    EXPECT_EQ(answer("Host: localhost:80\r\nOrigin: http://localhost:80\r\n").body, "the page");
    EXPECT_EQ(answer("Host: 127.0.0.1\r\nOrigin: https://map.example.org\r\n").body, "the page");
}

TEST_F(WebRequestsTest, HeadHasNoBody) {
    start();
    Browser one = browser();
    one.send("HEAD / HTTP/1.1\r\n\r\nGET /b HTTP/1.1\r\n\r\n");
    const Received head = next(one, false);
    EXPECT_EQ(head.status, 200);
    EXPECT_EQ(head.field("Content-Length"), "8");
    EXPECT_EQ(next(one).body, "b") << "nothing lies between the answers";
}

TEST_F(WebRequestsTest, KeepsConnectionsOpen) {
    start();
    Browser one = browser();
    for (const char* name : {"a", "b", "c"}) {
        one.get(std::string("/") + name);
        EXPECT_EQ(next(one).body, name);
    }
    EXPECT_FALSE(one.isClosed());
    EXPECT_EQ(server_->statistics().opened, 1u);
    EXPECT_EQ(connectionCount(), 1u);
    one.get("/d", "Connection: close\r\n");
    const Received last = next(one);
    EXPECT_EQ(last.body, "d");
    EXPECT_EQ(last.field("Connection"), "close");
    EXPECT_TRUE(isClosedSoon(one));
    Browser old = browser();
    old.send("GET /e HTTP/1.0\r\n\r\n");
    EXPECT_EQ(next(old).body, "e");
    EXPECT_TRUE(isClosedSoon(old));
    EXPECT_TRUE(runUntil([&] { return connectionCount() == 0; }));
}

TEST_F(WebRequestsTest, AKnownTagIsNotSentAgain) {
    start();
    Browser one = browser();
    for (const char* known : {"\"t1\"", "W/\"t1\"", "\"t0\", \"t1\""}) {
        one.get("/", std::string("If-None-Match: ") + known + "\r\n");
        const Received answer = next(one);
        EXPECT_EQ(answer.status, 304) << known;
        EXPECT_EQ(answer.field("ETag"), "\"t1\"");
        EXPECT_EQ(answer.field("Content-Length"), "");
    }
    for (const char* other : {"\"t2\"", "t1", "\"\"", "\"xt1\""}) {
        one.get("/", std::string("If-None-Match: ") + other + "\r\n");
        EXPECT_EQ(next(one).body, "the page") << other;
    }
    one.get("/other", "If-None-Match: \"\"\r\n");
    EXPECT_EQ(next(one).status, 200) << "it has no tag";
    EXPECT_EQ(server_->statistics().answers3xx, 3u);
}

TEST_F(WebRequestsTest, RefusesWhatItDoesNotDo) {
    start();
    const Received post = answerTo("POST / HTTP/1.1\r\nContent-Length: 0\r\n\r\n");
    EXPECT_EQ(post.status, 405);
    EXPECT_EQ(post.field("Allow"), "GET, HEAD");
    for (const char* method : {"PUT", "DELETE", "OPTIONS", "TRACE", "BREW"})
        EXPECT_EQ(answerTo(std::string(method) + " / HTTP/1.1\r\n\r\n").status, 405) << method;
    EXPECT_EQ(answerTo("GET /api/none HTTP/1.1\r\n\r\n").status, 404);
    EXPECT_EQ(answerTo("GET /tiles/day/99/0/0.png HTTP/1.1\r\n\r\n").status, 404);
    EXPECT_EQ(answerTo("GET /api/block?x=1 HTTP/1.1\r\n\r\n").status, 400);
    for (const char* target : {"/../etc/passwd", "/%2e%2e/x", "/a%2fb", "/%00", "http://other/", "*", "/%"})
        EXPECT_EQ(answerTo(std::string("GET ") + target + " HTTP/1.1\r\n\r\n").status, 400) << target;
    EXPECT_EQ(server_->statistics().answers2xx, 0u);
    EXPECT_EQ(server_->statistics().answers5xx, 0u);
}

TEST_F(WebRequestsTest, AConnectionGoesOnAfterARefusal) {
    start();
    Browser one = browser();
    one.send("GET /../x HTTP/1.1\r\n\r\nDELETE / HTTP/1.1\r\n\r\nGET /a HTTP/1.1\r\n\r\n");
    EXPECT_EQ(next(one).status, 400);
    EXPECT_EQ(next(one).status, 405);
    EXPECT_EQ(next(one).body, "a");
}

TEST_F(WebRequestsTest, WhatIsNoRequestClosesTheConnection) {
    start();
    for (const std::string& text : std::vector<std::string>{
             "hello\r\n\r\n", "GET\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "GET / HTTP/1.1\r\nno field\r\n\r\n",
             "GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
             std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\r\n\r\n", 13)}) {
        Browser one = browser();
        one.send(text);
        EXPECT_EQ(next(one).status, 400) << text;
        EXPECT_TRUE(isClosedSoon(one)) << text;
    }
    EXPECT_EQ(server_->statistics().requests, 0u);
}

TEST_F(WebRequestsTest, BodiesAreRefused) {
    start();
    for (const std::string& text : std::vector<std::string>{
             "GET / HTTP/1.1\r\nContent-Length: 5\r\n\r\nhello",
             "POST / HTTP/1.1\r\nContent-Length: 999999999999\r\n\r\n",
             "GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nGET /\r\n0\r\n\r\n"}) {
        Browser one = browser();
        one.send(text);
        EXPECT_EQ(next(one).status, 413) << text;
        EXPECT_TRUE(isClosedSoon(one)) << text;
        EXPECT_EQ(one.text(), "") << "what follows is no request";
    }
}

TEST_F(WebRequestsTest, HeadersAreLimited) {
    start();
    EXPECT_EQ(answerTo("GET / HTTP/1.1\r\nCookie: " + std::string(7000, 'c') + "\r\n\r\n").status, 200);
    EXPECT_EQ(answerTo("GET / HTTP/1.1\r\nCookie: " + std::string(9000, 'c') + "\r\n\r\n").status, 431);
    EXPECT_EQ(answerTo("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n\r\n").status, 431);
    std::string many = "GET / HTTP/1.1\r\n";
    for (int k = 0; k < 1000; ++k) many += "A" + std::to_string(k) + ": b\r\n";
    EXPECT_EQ(answerTo(many + "\r\n").status, 431);
    // Without the final empty line.
    for (const std::string& part : {std::string(3000, 'x'), std::string("A: b\r\n"), std::string("\r\n")}) {
        Browser endless = browser();
        endless.send("GET / HTTP/1.1\r\nEndless: b");
        std::size_t sent = 0;
        EXPECT_TRUE(runUntil([&] {
            for (int k = 0; k < 20; ++k, sent += part.size()) endless.send(part);
            return endless.isClosed() || sent > 1000000;
        }));
        EXPECT_LE(sent, 1000000u) << "never closed";
    }
    EXPECT_TRUE(runUntil([&] { return connectionCount() == 0; }));
}

TEST_F(WebRequestsTest, RequestsInARowAreAnsweredInTheirOrder) {
    start();
    Browser one = browser();
    std::string text;
    for (int k = 0; k < 200; ++k) text += "GET /" + std::to_string(k) + " HTTP/1.1\r\n\r\n";
    one.send(text);
    for (int k = 0; k < 200; ++k) ASSERT_EQ(next(one).body, std::to_string(k));
    // Also if the first answer takes long, and for single bytes.
    one.send("GET /api/block?x=1&y=2 HTTP/1.1\r\n\r\nGET /after HTTP/1.1\r\n\r\n");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 1; }));
    runShortly();
    EXPECT_EQ(one.text(), "");
    replies_[0](textResponse(200, "late"));
    EXPECT_EQ(next(one).body, "late");
    EXPECT_EQ(next(one).body, "after");
    for (const char c : std::string("GET /bytes HTTP/1.1\r\nA: b\r\n\r\n")) {
        one.send(std::string(1, c));
        context_.restart();
        context_.poll();
    }
    EXPECT_EQ(next(one).body, "bytes");
}

TEST_F(WebRequestsTest, LargeAnswersComeWhole) {
    start();
    const Received answer = answerTo("GET /large.bin HTTP/1.1\r\n\r\n");
    EXPECT_EQ(answer.body.size(), large_->size());
    EXPECT_TRUE(answer.body == *large_);
    EXPECT_TRUE(runUntil([&] { return large_.use_count() == 1; }))
        << "the answer is not kept, and was not copied";
    EXPECT_GT(server_->statistics().bytesSent, large_->size());
}

TEST_F(WebRequestsTest, ACloseCancelsTheAnswer) {
    start();
    Browser one = browser();
    one.get("/api/block?x=1&y=2");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 1; }));
    EXPECT_EQ(cancelled_, 0);
    one.close();
    EXPECT_TRUE(runUntil([&] { return cancelled_ == 1; }));
    EXPECT_EQ(connectionCount(), 0u);
    replies_[0](textResponse(200, "nobody is there"));
    runShortly();
    EXPECT_EQ(cancelled_, 1);
}

TEST_F(WebRequestsTest, AnAnswerCountsOnce) {
    start();
    Browser one = browser();
    one.get("/api/block?x=1&y=2");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 1; }));
    replies_[0](textResponse(200, "first"));
    replies_[0](textResponse(200, "second"));
    EXPECT_EQ(next(one).body, "first");
    one.get("/api/block?x=3&y=4");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 2; }));
    replies_[0](textResponse(200, "of the former request"));
    replies_[1](textResponse(200, "third"));
    EXPECT_EQ(next(one).body, "third");
    one.close();
    EXPECT_TRUE(runUntil([&] { return connectionCount() == 0; }));
    EXPECT_EQ(cancelled_, 0);
}

TEST_F(WebRequestsTest, EventsReachAllListeners) {
    start();
    hub_.publish("players", "[1]", true);
    Browser one = browser(), two = browser();
    for (Browser* each : {&one, &two}) each->get("/api/edits");
    ASSERT_TRUE(runUntil([&] { return hub_.count() == 2; }));
    EXPECT_EQ(server_->statistics().listeners, 2u);
    hub_.publish("edits", "[2]", false);
    hub_.sendKeepAlive();
    for (Browser* each : {&one, &two}) {
        const Received header = next(*each);
        EXPECT_EQ(header.status, 200);
        EXPECT_EQ(header.field("Content-Type"), "text/event-stream");
        const std::string expected = "event: players\ndata: [1]\n\nevent: edits\ndata: [2]\n\n:\n\n";
        EXPECT_TRUE(runUntil([&] { return each->text() == expected; })) << each->text();
    }
    one.close();
    EXPECT_TRUE(runUntil([&] { return server_->statistics().listeners == 1; }));
    hub_.publish("edits", "[3]", false);
    EXPECT_EQ(hub_.count(), 1u);
    EXPECT_TRUE(runUntil([&] { return two.text().ends_with("event: edits\ndata: [3]\n\n"); }));
}

TEST_F(WebRequestsTest, HeadOfEventsEnds) {
    start();
    Browser one = browser();
    one.send("HEAD /api/edits HTTP/1.1\r\n\r\n");
    EXPECT_EQ(next(one, false).status, 200);
    EXPECT_EQ(hub_.count(), 0u);
}

TEST_F(WebRequestsTest, AListenerWhoDoesNotReadIsDropped) {
    WebLimits limits;
    // Room for three: an event that was heard may still count until the server learns that it was sent.
    limits.unsentEventBytes = 180000;
    start(limits);
    Browser lazy = browser("127.0.0.1", 4096), good = browser();
    for (Browser* each : {&lazy, &good}) each->get("/api/edits");
    ASSERT_TRUE(runUntil([&] { return hub_.count() == 2; }));
    const std::string data(50000, 'x');
    std::size_t told = 0, heard = 0;
    EXPECT_TRUE(runUntil([&] {
        // The other one hears each event before the next, so that it never falls behind.
        heard = good.text().size();
        if (heard >= told) {
            hub_.publish("edits", data, false);
            told += data.size();
        }
        return hub_.count() == 1 || told > (64u << 20);
    }));
    EXPECT_EQ(hub_.count(), 1u) << "after " << told << " bytes";
    EXPECT_EQ(server_->statistics().listeners, 1u);
    EXPECT_EQ(server_->statistics().refused, 1u);
    EXPECT_EQ(connectionCount(), 1u);
    hub_.publish("edits", "last", false);
    EXPECT_TRUE(runUntil([&] { return good.text().ends_with("data: last\n\n"); })) << "the others go on";
    EXPECT_GT(heard, 0u);
}

}  // namespace
}  // namespace terrane::web
