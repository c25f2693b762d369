// What a gamepad's buttons did since the frame before: the pad itself tells only which are down.
#pragma once

#include <optional>

#include "apps/terrane/window/input.h"
#include "terrane/game/held_button.h"

namespace terrane::app {

class PadReader {
  public:
    using Button = bool Gamepad::*;

    // Once a frame. Without a pad nothing is down: what was, is released.
    void read(const std::optional<Gamepad>& pad) {
        before_ = now_;
        now_ = pad.value_or(Gamepad());
    }
    const Gamepad& now() const { return now_; }
    bool isPressed(Button button) const { return now_.*button && !(before_.*button); }
    bool isReleased(Button button) const { return !(now_.*button) && before_.*button; }
    // Leaves alone what the mouse does with the same button.
    void drive(game::HeldButton& held, Button button) const {
        if (isPressed(button)) held.press();
        if (isReleased(button)) held.release();
    }

  private:
    Gamepad before_, now_;
};

}  // namespace terrane::app
