// Chat lines over the image, the input line, and the list of players. Immediate mode: drawn each frame.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>

#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/text.h"
#include "terrane/net/client/client_world.h"

namespace terrane::app {

class ChatView {
  public:
    void add(const net::ChatLine& line, double seconds);

    bool isTyping() const { return isTyping_; }
    void beginTyping();
    void endTyping() { isTyping_ = false; }

    // Draws the last lines, which fade out; while typing, all that fit. Returns an entered line once.
    // `seconds`: since the start.
    std::optional<std::string> draw(const Screen& screen, const Texts& tr, double seconds);

  private:
    struct ShownLine {
        std::string text;
        double since = 0;
    };
    std::optional<std::string> drawInput(const Screen& screen, const Texts& tr);

    std::deque<ShownLine> lines_;
    std::array<char, net::kMaxChatBytes + 1> typed_{};
    bool isTyping_ = false, takesFocus_ = false;
};

// The list of players with their ping in milliseconds.
void drawPlayerList(const Screen& screen, const Texts& tr, const net::PlayerList& list);

}  // namespace terrane::app
