// The lines of a sign while a player types them. Immediate mode: draws, and tells what the player chose.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "apps/terrane/window/input.h"
#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"
#include "terrane/world/sign.h"

namespace terrane::app {

class SignDialog {
  public:
    enum class Choice : std::uint8_t { Done, Cancel };

    SignDialog(world::BlockPos sign, const world::SignText& text);

    world::BlockPos sign() const { return sign_; }
    world::SignText text() const;
    // Enter, Escape, and up and down from line to line. What is typed in the same frame is not lost: draw()
    // gives the choice.
    void onKey(Key key);
    std::optional<Choice> draw(const Screen& screen, const Texts& tr);

  private:
    // A line's bytes and an end.
    using Line = std::array<char, world::kSignColumns * 4 + 1>;

    world::BlockPos sign_;
    std::array<Line, world::kSignLines> lines_{};
    std::size_t line_ = 0;  // that is typed
    bool takesFocus_ = true;
    std::optional<Choice> choice_;
};

}  // namespace terrane::app
