#include "apps/terrane/window/input.h"

#include <algorithm>
#include <iterator>

namespace terrane::app {

void setPadNavigation(const std::optional<Gamepad>& pad, float (&inputs)[ImGuiNavInput_COUNT]) {
    std::fill(std::begin(inputs), std::end(inputs), 0.0f);
    if (!pad) return;
    constexpr float kTilt = 0.5f;
    const auto set = [&](ImGuiNavInput input, bool isDown) { inputs[input] = isDown ? 1.0f : 0.0f; };
    set(ImGuiNavInput_Activate, pad->south);
    set(ImGuiNavInput_Cancel, pad->east);
    set(ImGuiNavInput_DpadLeft, pad->left || pad->leftX < -kTilt);
    set(ImGuiNavInput_DpadRight, pad->right || pad->leftX > kTilt);
    set(ImGuiNavInput_DpadUp, pad->up || pad->leftY > kTilt);
    set(ImGuiNavInput_DpadDown, pad->down || pad->leftY < -kTilt);
}

}  // namespace terrane::app
