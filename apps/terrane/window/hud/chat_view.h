// Chat lines over the image, the input line, and the list of players. Immediate mode: drawn each frame.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/text.h"
#include "terrane/net/client/client_world.h"

namespace terrane::app {

class ChatView {
  public:
    void add(const net::ChatLine& line, double seconds);

    bool isTyping() const { return isTyping_; }
    void beginTyping();
    void endTyping();  // the newest line is shown again

    // While typing: scrolls by lines to older ones, or to newer ones if negative. Lines that arrive meanwhile
    // do not move those on the screen.
    void scroll(int lines);
    void scrollPages(int pages) { scroll(pages * pageLines_); }

    // Draws the last lines, which fade out; while typing a page of lines, the last one or older ones. Returns
    // an entered line once. `seconds`: since the start.
    std::optional<std::string> draw(OverlayLayout& layout, const Texts& tr, double seconds);

    std::size_t lineCount() const { return lines_.size(); }

  private:
    struct ShownLine {
        std::string text;
        double since = 0;
    };
    void drawLines(OverlayLayout& layout, const Texts& tr, double seconds);
    std::optional<std::string> drawInput(OverlayLayout& layout, const Texts& tr);

    std::deque<ShownLine> lines_;
    std::size_t newer_ = 0;  // lines below the page
    int pageLines_ = 1;      // of the last frame
    std::array<char, net::kMaxChatBytes + 1> typed_{};
    bool isTyping_ = false, takesFocus_ = false;
};

// The list of players with their ping in milliseconds.
void drawPlayerList(OverlayLayout& layout, const Texts& tr, const net::PlayerList& list);

}  // namespace terrane::app
