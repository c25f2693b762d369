// Detects presses and releases of gamepad buttons since the last frame, from their current state.
#pragma once

#include <optional>

#include "apps/terrane/window/input.h"
#include "terrane/game/held_button.h"

namespace terrane::app {

class PadReader {
  public:
    using Button = bool Gamepad::*;

    // Call once per frame. Without a gamepad all buttons count as released.
    void read(const std::optional<Gamepad>& pad) {
        before_ = now_;
        now_ = pad.value_or(Gamepad());
    }
    const Gamepad& now() const { return now_; }
    bool isPressed(Button button) const { return now_.*button && !(before_.*button); }
    bool isReleased(Button button) const { return !(now_.*button) && before_.*button; }
    // Presses and releases `held` with the button; the mouse may hold it as well.
    void drive(game::HeldButton& held, Button button) const {
        if (isPressed(button)) held.press();
        if (isReleased(button)) held.release();
    }

  private:
    Gamepad before_, now_;
};

}  // namespace terrane::app
