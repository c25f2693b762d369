#include "apps/terrane/window/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>

#include "apps/terrane/window/text.h"

namespace terrane::app {
namespace {

constexpr std::array kPadButtons = {
    PadButtonRow{PadButton::South, "South", trLater("Lower button"), &Gamepad::south},
    PadButtonRow{PadButton::East, "East", trLater("Right button"), &Gamepad::east},
    PadButtonRow{PadButton::West, "West", trLater("Left button"), &Gamepad::west},
    PadButtonRow{PadButton::North, "North", trLater("Upper button"), &Gamepad::north},
    PadButtonRow{PadButton::LeftBumper, "LeftBumper", trLater("Left bumper"), &Gamepad::leftBumper},
    PadButtonRow{PadButton::RightBumper, "RightBumper", trLater("Right bumper"), &Gamepad::rightBumper},
    PadButtonRow{PadButton::LeftTrigger, "LeftTrigger", trLater("Left trigger"), &Gamepad::leftTrigger},
    PadButtonRow{PadButton::RightTrigger, "RightTrigger", trLater("Right trigger"), &Gamepad::rightTrigger},
    PadButtonRow{PadButton::Up, "Up", trLater("D-pad up"), &Gamepad::up},
    PadButtonRow{PadButton::Down, "Down", trLater("D-pad down"), &Gamepad::down},
    PadButtonRow{PadButton::Left, "Left", trLater("D-pad left"), &Gamepad::left},
    PadButtonRow{PadButton::Right, "Right", trLater("D-pad right"), &Gamepad::right},
    PadButtonRow{PadButton::Back, "Back", trLater("Back button"), &Gamepad::back},
    PadButtonRow{PadButton::LeftStick, "LeftStick", trLater("Left stick"), &Gamepad::leftStick},
    PadButtonRow{PadButton::RightStick, "RightStick", trLater("Right stick"), &Gamepad::rightStick},
    PadButtonRow{PadButton::Start, "Start", trLater("Start button"), &Gamepad::start},
};
static_assert(kPadButtons.size() == static_cast<std::size_t>(PadButton::kCount));

}  // namespace

std::span<const PadButtonRow> padButtonTable() {
    return kPadButtons;
}

const PadButtonRow& rowOf(PadButton button) {
    const PadButtonRow& row = kPadButtons[static_cast<std::size_t>(button)];
    assert(row.button == button && "the table is in the order of the buttons");
    return row;
}

bool PadReader::isAnyDown() const {
    return std::ranges::any_of(kPadButtons, [&](const PadButtonRow& row) { return now_.*row.member; });
}

std::optional<PadButton> PadReader::pressed() const {
    const auto found =
        std::ranges::find_if(kPadButtons, [&](const PadButtonRow& row) { return isPressed(row.member); });
    return found == kPadButtons.end() ? std::nullopt : std::optional(found->button);
}

std::vector<std::string> UnknownPads::take(std::span<const Joystick> joysticks, std::string_view mappings) {
    std::vector<std::string> lines;
    for (const Joystick& joystick : joysticks) {
        if (joystick.isGamepad || !told_.insert(joystick.guid).second) continue;
        lines.push_back(
            fmt::format("{} (joystick {}) is not used: its buttons are not known; add its line of SDL's "
                        "gamecontrollerdb.txt to {} and start again",
                        joystick.name, joystick.guid, mappings));
    }
    return lines;
}

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
