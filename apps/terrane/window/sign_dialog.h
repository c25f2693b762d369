// The dialog that edits the lines of a sign. Immediate mode: draws, and returns the choice.
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
    // Handles Enter, Escape, and up and down between lines. The choice comes from draw(), after text typed in
    // the same frame.
    void onKey(Key key);
    std::optional<Choice> draw(const Screen& screen, const Texts& tr);

  private:
    // The bytes of a line and a terminator.
    using Line = std::array<char, world::kSignColumns * 4 + 1>;

    world::BlockPos sign_;
    std::array<Line, world::kSignLines> lines_{};
    std::size_t line_ = 0;  // with the focus
    bool takesFocus_ = true;
    std::optional<Choice> choice_;
};

}  // namespace terrane::app
