// An HTTP response. Plain values.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace terrane::web {

struct Answer {
    int status = 200;
    std::string_view type = "text/plain; charset=utf-8";  // refers to a constant
    std::shared_ptr<const std::string> body = nullptr;    // null: empty
    std::string tag = {};                                 // ETag; empty: none
    // Seconds for which the browser may cache; 0: it revalidates each time with the tag.
    int maxAge = 0;
    int retryAfter = 0;  // seconds; 0: no header
};

// The head of an HTTP/1.1 response: status line, fields, empty line. `keepsOpen`: another request may follow.
std::string headerOf(const Answer& answer, bool keepsOpen);
// The head of a stream of server-sent events.
std::string streamHeader();

inline Answer textAnswer(int status, std::string text) {
    return {.status = status, .body = std::make_shared<const std::string>(std::move(text))};
}
// An error that may be temporary: asks the client to retry after a second.
inline Answer busyAnswer(int status, std::string text) {
    Answer answer = textAnswer(status, std::move(text));
    answer.retryAfter = 1;
    return answer;
}
inline Answer jsonAnswer(std::string text) {
    return {.type = "application/json", .body = std::make_shared<const std::string>(std::move(text))};
}

}  // namespace terrane::web
