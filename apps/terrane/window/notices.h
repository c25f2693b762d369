// What the window tells a player for some seconds: a message, and the list of keys. Plain state.
#pragma once

#include <string>
#include <utility>

#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {

struct Notices {
    static constexpr double kMessageSeconds = 3, kHelpSeconds = 20;

    std::string message;
    double messageSeconds = 0;  // that are left
    double helpSeconds = 12;    // of the list of keys; who begins sees it for a while

    void say(std::string text, double seconds = kMessageSeconds) {
        message = std::move(text);
        messageSeconds = seconds;
    }
    void advance(double seconds) {
        messageSeconds -= seconds;
        helpSeconds -= seconds;
    }
};

void drawNotices(const Screen& screen, const Notices& notices, const Texts& tr);

}  // namespace terrane::app
