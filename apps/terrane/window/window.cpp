#include "apps/terrane/window/window.h"

#include <glm/common.hpp>
#include <glm/ext/vector_int2_sized.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace terrane::app {

std::size_t monitorOf(const ScreenArea& window, std::span<const ScreenArea> monitors) {
    std::size_t best = 0;
    std::int64_t most = 0;
    for (std::size_t k = 0; k < monitors.size(); ++k) {
        const glm::i64vec2 low = glm::max(window.corner, monitors[k].corner),
                           high =
                               glm::min(window.corner + window.size, monitors[k].corner + monitors[k].size);
        const std::int64_t common =
            std::max<std::int64_t>(high.x - low.x, 0) * std::max<std::int64_t>(high.y - low.y, 0);
        if (common > most) best = k;
        most = std::max(most, common);
    }
    return best;
}

void Window::pollEvents() {
    events_.clear();
    characters_.clear();
    isAnyKeyPressed_ = false;
    receiveEvents();
}

void Window::onKey(std::optional<Key> key, bool isPress, Modifiers with) {
    isAnyKeyPressed_ |= isPress;
    if (!key) return;
    int& count = keysDown_[static_cast<std::size_t>(*key)];
    count = std::max(0, count + (isPress ? 1 : -1));
    if (!isPress) return;
    events_.push_back({.type = InputEvent::Type::KeyPress,
                       .key = *key,
                       .withShift = with.shift,
                       .withControl = with.control,
                       .seconds = timeSeconds()});
}

void Window::onCharacter(unsigned character) {
    characters_.push_back(character);
}

void Window::onMouseButton(int number, bool isPress, Modifiers with) {
    constexpr int kFirstKey = 3;
    constexpr int kLastKey = kFirstKey + static_cast<int>(Key::Mouse8) - static_cast<int>(Key::Mouse4);
    if (number >= 0 && number < kFirstKey)
        onButton(static_cast<MouseButton>(number), isPress, with);
    else if (number >= kFirstKey && number <= kLastKey)
        onKey(static_cast<Key>(static_cast<int>(Key::Mouse4) + number - kFirstKey), isPress, with);
}

void Window::onButton(MouseButton button, bool isPress, Modifiers with) {
    buttonsDown_[static_cast<std::size_t>(button)] = isPress;
    events_.push_back({.type = isPress ? InputEvent::Type::ButtonPress : InputEvent::Type::ButtonRelease,
                       .button = button,
                       .withShift = with.shift,
                       .withControl = with.control});
}

void Window::onWheel(glm::dvec2 steps) {
    events_.push_back({.type = InputEvent::Type::Wheel,
                       .x = steps.x,
                       .y = steps.y,
                       .withShift = keyDown(Key::Shift),
                       .withControl = keyDown(Key::Control)});
}

void Window::onCursor(glm::dvec2 position) {
    const glm::dvec2 delta = position - std::exchange(lastCursor_, position);
    if (!std::exchange(cursorKnown_, true)) return;
    events_.push_back({.type = InputEvent::Type::CursorMove, .x = delta.x, .y = delta.y});
}

void Window::setCursorCaptured(bool captured) {
    captureCursor(captured);
    // The position jumps when the mode changes; that jump is no mouse motion.
    cursorKnown_ = false;
}

float Window::pixelsPerUnit() const {
    const int width = size().x, pixels = framebufferSize().x;
    return width > 0 && pixels > 0 ? static_cast<float>(pixels) / static_cast<float>(width) : 1.0F;
}

}  // namespace terrane::app
