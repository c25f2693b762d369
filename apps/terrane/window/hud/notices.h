// Temporary notices in the window: a message, the list of keys, and the hint for a new player. Plain state.
#pragma once

#include <string>
#include <utility>

#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/settings/key_bindings.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {

struct Notices {
    static constexpr double kMessageSeconds = 3, kHelpSeconds = 20, kHintSeconds = 20;

    std::string message;
    double messageSeconds = 0;  // remaining
    double helpSeconds = 0;     // remaining for the list of keys
    double hintSeconds = 0;     // remaining for the hint

    // Nothing if the text is empty.
    void say(std::string text, double seconds = kMessageSeconds) {
        if (text.empty()) return;
        message = std::move(text);
        messageSeconds = seconds;
    }
    void advance(double seconds) {
        messageSeconds -= seconds;
        helpSeconds -= seconds;
        hintSeconds -= seconds;
    }
};

void drawNoticeMessage(OverlayLayout& layout, const Notices& notices);
void drawNoticeKeys(OverlayLayout& layout, const Notices& notices, const KeyBindings& keys, const Texts& tr);

}  // namespace terrane::app
