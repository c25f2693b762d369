#include "apps/terrane/window/window.h"

#include <epoxy/gl.h>
// epoxy declares OpenGL; GLFW must not.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cassert>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "terrane/gpu/device_info.h"

namespace terrane::app {

namespace {

// Position of a window that was created as full screen, once it leaves full screen.
constexpr int kLeft = 40, kTop = 40;

struct KeyCode {
    Key key;
    int code;
};

constexpr KeyCode kOtherKeys[] = {
    {Key::Escape, GLFW_KEY_ESCAPE},
    {Key::Space, GLFW_KEY_SPACE},
    {Key::Tab, GLFW_KEY_TAB},
    {Key::Enter, GLFW_KEY_ENTER},
    {Key::Enter, GLFW_KEY_KP_ENTER},
    {Key::Delete, GLFW_KEY_DELETE},
    {Key::Shift, GLFW_KEY_LEFT_SHIFT},
    {Key::Shift, GLFW_KEY_RIGHT_SHIFT},
    {Key::Control, GLFW_KEY_LEFT_CONTROL},
    {Key::Control, GLFW_KEY_RIGHT_CONTROL},
    {Key::Left, GLFW_KEY_LEFT},
    {Key::Right, GLFW_KEY_RIGHT},
    {Key::Up, GLFW_KEY_UP},
    {Key::Down, GLFW_KEY_DOWN},
};

struct KeyRun {
    Key first;
    Key last;
    int firstCode;
};

constexpr KeyRun kKeyRuns[] = {
    {Key::A, Key::Z, GLFW_KEY_A}, {Key::Digit0, Key::Digit9, GLFW_KEY_0}, {Key::F1, Key::F12, GLFW_KEY_F1}};

std::optional<Key> keyOfCode(int code) {
    for (const KeyRun& run : kKeyRuns) {
        const int index = code - run.firstCode;
        const int count = static_cast<int>(run.last) - static_cast<int>(run.first) + 1;
        if (index >= 0 && index < count) return static_cast<Key>(static_cast<int>(run.first) + index);
    }
    for (const KeyCode& entry : kOtherKeys)
        if (entry.code == code) return entry.key;
    return std::nullopt;
}

std::string lastError() {
    const char* description = nullptr;
    if (glfwGetError(&description) == GLFW_NO_ERROR || description == nullptr) return "unknown reason";
    return description;
}

GLFWwindow* openWindow(const WindowOptions& options) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // rendering uses its own framebuffers
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    GLFWmonitor* monitor = options.fullScreen ? glfwGetPrimaryMonitor() : nullptr;
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr)
        return glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
    return glfwCreateWindow(mode->width, mode->height, options.title.c_str(), monitor, nullptr);
}

}  // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    std::vector<InputEvent> events;
    bool isAnyKeyPressed = false;
    glm::dvec2 cursor = {0.0, 0.0};
    bool cursorKnown = false;  // false: the next position is only a reference
    std::unique_ptr<gpu::DebugLog> debugLog;
    glm::ivec4 place{kLeft, kTop, 1280, 720};  // and size of the window, to restore after full screen

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (window != nullptr) glfwDestroyWindow(window);
        glfwTerminate();
    }

    void installCallbacks();

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }
    static void onKey(GLFWwindow* window, int code, int scanCode, int action, int modifiers);
    static void onButton(GLFWwindow* window, int button, int action, int modifiers);
    static void onWheel(GLFWwindow* window, double x, double y);
    static void onCursor(GLFWwindow* window, double x, double y);
};

void Window::State::installCallbacks() {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, onKey);
    glfwSetMouseButtonCallback(window, onButton);
    glfwSetScrollCallback(window, onWheel);
    glfwSetCursorPosCallback(window, onCursor);
}

void Window::State::onKey(GLFWwindow* window, int code, int, int action, int modifiers) {
    if (action == GLFW_PRESS) of(window).isAnyKeyPressed = true;
    const std::optional<Key> key = keyOfCode(code);
    if (!key || action != GLFW_PRESS) return;
    of(window).events.push_back({.type = InputEvent::Type::KeyPress,
                                 .key = *key,
                                 .withShift = (modifiers & GLFW_MOD_SHIFT) != 0,
                                 .withControl = (modifiers & GLFW_MOD_CONTROL) != 0});
}

void Window::State::onButton(GLFWwindow* window, int button, int action, int modifiers) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;  // left, right, middle are 0, 1, 2 as in MouseButton
    const auto type = action == GLFW_PRESS ? InputEvent::Type::ButtonPress : InputEvent::Type::ButtonRelease;
    of(window).events.push_back({.type = type,
                                 .button = static_cast<MouseButton>(button),
                                 .withShift = (modifiers & GLFW_MOD_SHIFT) != 0,
                                 .withControl = (modifiers & GLFW_MOD_CONTROL) != 0});
}

void Window::State::onWheel(GLFWwindow* window, double x, double y) {
    of(window).events.push_back({.type = InputEvent::Type::Wheel, .x = x, .y = y});
}

void Window::State::onCursor(GLFWwindow* window, double x, double y) {
    State& state = of(window);
    const glm::dvec2 position(x, y);
    const glm::dvec2 delta = position - state.cursor;
    state.cursor = position;
    if (!std::exchange(state.cursorKnown, true)) return;
    state.events.push_back({.type = InputEvent::Type::CursorMove, .x = delta.x, .y = delta.y});
}

Window::Window() = default;
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

base::Result<Window> Window::create(const WindowOptions& options) {
    assert(options.width > 0 && options.height > 0 && "a window has a size");
    if (glfwInit() == GLFW_FALSE) return base::fail("no display: {}", lastError());
    Window result;
    result.state_ = std::make_unique<State>();
    State& state = *result.state_;
    state.window = openWindow(options);
    if (state.window == nullptr)
        return base::fail("no window with an OpenGL 4.5 core context: {}", lastError());
    glfwMakeContextCurrent(state.window);
    if (base::Result<void> fit = gpu::checkRequirements(); !fit) return tl::unexpected(fit.error());
    if (options.debug) state.debugLog = gpu::enableDebugOutput(false);
    result.setVsync(true);
    glfwSetTime(0.0);
    state.installCallbacks();
    if (options.fullScreen) state.place = {kLeft, kTop, options.width, options.height};
    return result;
}

void Window::setVsync(bool isOn) {
    glfwSwapInterval(isOn ? 1 : 0);
}

void Window::pollEvents() {
    state_->events.clear();
    state_->isAnyKeyPressed = false;
    glfwPollEvents();
}

std::span<const InputEvent> Window::events() const {
    return state_->events;
}

bool Window::anyKeyPressed() const {
    return state_->isAnyKeyPressed;
}

bool Window::keyDown(Key key) const {
    for (const KeyRun& run : kKeyRuns)
        if (key >= run.first && key <= run.last) {
            const int code = run.firstCode + static_cast<int>(key) - static_cast<int>(run.first);
            return glfwGetKey(state_->window, code) == GLFW_PRESS;
        }
    for (const KeyCode& entry : kOtherKeys)
        if (entry.key == key && glfwGetKey(state_->window, entry.code) == GLFW_PRESS) return true;
    return false;
}

void Window::swapBuffers() {
    glfwSwapBuffers(state_->window);
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

void Window::cancelClose() {
    glfwSetWindowShouldClose(state_->window, GLFW_FALSE);
}

glm::ivec2 Window::framebufferSize() const {
    glm::ivec2 size(0, 0);
    glfwGetFramebufferSize(state_->window, &size.x, &size.y);
    return size;
}

float Window::contentScale() const {
    float scaleX = 1.0F, scaleY = 1.0F;
    glfwGetWindowContentScale(state_->window, &scaleX, &scaleY);
    return scaleX;
}

float Window::pixelsPerUnit() const {
    int width = 0, height = 0;
    glfwGetWindowSize(state_->window, &width, &height);
    const glm::ivec2 pixels = framebufferSize();
    return width > 0 && pixels.x > 0 ? static_cast<float>(pixels.x) / static_cast<float>(width) : 1.0F;
}

void Window::setFullScreen(bool isFullScreen) {
    State& s = *state_;
    if (isFullScreen == (glfwGetWindowMonitor(s.window) != nullptr)) return;
    if (!isFullScreen) {
        glfwSetWindowMonitor(s.window, nullptr, s.place.x, s.place.y, s.place.z, s.place.w, 0);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(s.window, &s.place.x, &s.place.y);
    glfwGetWindowSize(s.window, &s.place.z, &s.place.w);
    glfwSetWindowMonitor(s.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::setIcon(int width, int height, std::span<const std::byte> pixels) {
    assert(pixels.size() ==
               std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) &&
           "four bytes for each pixel");
    std::vector<unsigned char> copy(pixels.size());  // GLFW takes a writable pointer
    std::memcpy(copy.data(), pixels.data(), pixels.size());
    const GLFWimage image{width, height, copy.data()};
    glfwSetWindowIcon(state_->window, 1, &image);
}

std::optional<Gamepad> Window::gamepad() const {
    GLFWgamepadstate state;
    if (glfwGetGamepadState(GLFW_JOYSTICK_1, &state) == GLFW_FALSE) return std::nullopt;
    const auto isDown = [&](int button) { return state.buttons[button] == GLFW_PRESS; };
    const auto stick = [&](int axisX, int axisY) {
        const glm::vec2 at(state.axes[axisX], -state.axes[axisY]);
        constexpr float kDeadZone = 0.15f;
        return glm::length(at) < kDeadZone ? glm::vec2(0) : at;
    };
    const glm::vec2 left = stick(GLFW_GAMEPAD_AXIS_LEFT_X, GLFW_GAMEPAD_AXIS_LEFT_Y);
    const glm::vec2 right = stick(GLFW_GAMEPAD_AXIS_RIGHT_X, GLFW_GAMEPAD_AXIS_RIGHT_Y);
    return Gamepad{left.x,
                   left.y,
                   right.x,
                   right.y,
                   isDown(GLFW_GAMEPAD_BUTTON_A),
                   isDown(GLFW_GAMEPAD_BUTTON_B),
                   isDown(GLFW_GAMEPAD_BUTTON_X),
                   isDown(GLFW_GAMEPAD_BUTTON_Y),
                   isDown(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER),
                   isDown(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER),
                   state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] > 0,
                   state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] > 0,
                   isDown(GLFW_GAMEPAD_BUTTON_DPAD_UP),
                   isDown(GLFW_GAMEPAD_BUTTON_DPAD_DOWN),
                   isDown(GLFW_GAMEPAD_BUTTON_DPAD_LEFT),
                   isDown(GLFW_GAMEPAD_BUTTON_DPAD_RIGHT),
                   isDown(GLFW_GAMEPAD_BUTTON_START)};
}

void Window::setCursorCaptured(bool captured) {
    glfwSetInputMode(state_->window, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    // The position jumps when the mode changes; that jump is no mouse motion.
    state_->cursorKnown = false;
}

double Window::timeSeconds() const {
    return glfwGetTime();
}

gpu::DebugLog* Window::debugLog() const {
    return state_->debugLog.get();
}

GLFWwindow* Window::handle() const {
    return state_->window;
}

}  // namespace terrane::app
