// What a browser is answered. Plain values.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace terrane::web {

struct Answer {
    int status = 200;
    std::string_view type = "text/plain; charset=utf-8";  // a constant
    std::shared_ptr<const std::string> body = nullptr;    // null: empty
    std::string tag = {};                                 // for ETag; empty: none
    // Seconds for which the browser need not ask again; 0: it asks each time, with the tag.
    int maxAge = 0;
    int retryAfter = 0;  // seconds; 0: not said
};

// The head of an HTTP/1.1 answer: its line, its fields, and the empty line. `keepsOpen`: another request may
// follow.
std::string headerOf(const Answer& answer, bool keepsOpen);
// That of server-sent events, which have no end.
std::string streamHeader();

inline Answer textAnswer(int status, std::string text) {
    return {.status = status, .body = std::make_shared<const std::string>(std::move(text))};
}
// Later it may be another one: a browser asks again.
inline Answer busyAnswer(int status, std::string text) {
    Answer answer = textAnswer(status, std::move(text));
    answer.retryAfter = 1;
    return answer;
}
inline Answer jsonAnswer(std::string text) {
    return {.type = "application/json", .body = std::make_shared<const std::string>(std::move(text))};
}

}  // namespace terrane::web
