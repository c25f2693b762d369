#include "apps/terrane/window/window.h"

#include <algorithm>
#include <utility>

namespace terrane::app {

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
                       .withControl = with.control});
}

void Window::onCharacter(unsigned character) {
    characters_.push_back(character);
}

void Window::onButton(MouseButton button, bool isPress, Modifiers with) {
    buttonsDown_[static_cast<std::size_t>(button)] = isPress;
    events_.push_back({.type = isPress ? InputEvent::Type::ButtonPress : InputEvent::Type::ButtonRelease,
                       .button = button,
                       .withShift = with.shift,
                       .withControl = with.control});
}

void Window::onWheel(glm::dvec2 steps) {
    events_.push_back({.type = InputEvent::Type::Wheel, .x = steps.x, .y = steps.y});
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
