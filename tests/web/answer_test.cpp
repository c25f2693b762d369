#include "terrane/web/web_server.h"

#include <gmock/gmock.h>

namespace terrane::web {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Response, HeadersEndWithAnEmptyLine) {
    for (const Response& answer : {Response{}, textResponse(404, "none\n"),
                                   Response{.status = 304, .tag = "abc"}, textResponse(431, "")}) {
        const std::string header = headerOf(answer, true);
        EXPECT_THAT(header, EndsWith("\r\n\r\n"));
        EXPECT_EQ(header.find("\r\n\r\n"), header.size() - 4) << "no empty line before its end";
        std::size_t newlines = 0, pairs = 0;
        for (std::size_t k = 0; k < header.size(); ++k) {
            newlines += header[k] == '\n';
            pairs += header.compare(k, 2, "\r\n") == 0;
        }
        EXPECT_EQ(newlines, pairs);
    }
}

TEST(Response, HeadersSayWhatFollows) {
    const std::string header = headerOf(jsonResponse("{}"), true);
    EXPECT_THAT(header, StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_THAT(header, HasSubstr("\r\nContent-Type: application/json\r\n"));
    EXPECT_THAT(header, HasSubstr("\r\nContent-Length: 2\r\n"));
    EXPECT_THAT(header, HasSubstr("\r\nCache-Control: no-cache\r\n"));
    EXPECT_THAT(header, HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"));
    EXPECT_THAT(header, HasSubstr("\r\nContent-Security-Policy: default-src 'none'"));
    EXPECT_THAT(header, Not(HasSubstr("ETag")));
    EXPECT_THAT(header, Not(HasSubstr("Retry-After")));
    EXPECT_THAT(header, Not(HasSubstr("Connection: close")));
    EXPECT_THAT(headerOf(Response{}, true), HasSubstr("Content-Length: 0\r\n"));
}

TEST(Response, HeadersOfSomeAnswersSayMore) {
    EXPECT_THAT(headerOf(Response{}, false), HasSubstr("\r\nConnection: close\r\n"));
    EXPECT_THAT(headerOf({.tag = "ab12"}, true), HasSubstr("\r\nETag: \"ab12\"\r\n"));
    EXPECT_THAT(headerOf({.maxAge = 60}, true), HasSubstr("\r\nCache-Control: max-age=60\r\n"));
    EXPECT_THAT(headerOf({.status = 503, .retryAfter = 2}, true), HasSubstr("\r\nRetry-After: 2\r\n"));
    EXPECT_THAT(headerOf(textResponse(405, ""), true), HasSubstr("\r\nAllow: GET, HEAD\r\n"));
    const std::string notModified = headerOf({.status = 304, .tag = "x"}, true);
    EXPECT_THAT(notModified, StartsWith("HTTP/1.1 304 Not Modified\r\n"));
    EXPECT_THAT(notModified, Not(HasSubstr("Content-Length")));
    EXPECT_THAT(notModified, HasSubstr("ETag"));
}

TEST(Response, EventsHaveNoEnd) {
    const std::string header = streamHeader();
    EXPECT_THAT(header, HasSubstr("Content-Type: text/event-stream\r\n"));
    EXPECT_THAT(header, Not(HasSubstr("Content-Length")));
    EXPECT_THAT(header, EndsWith("\r\n\r\n"));
}

}  // namespace
}  // namespace terrane::web
