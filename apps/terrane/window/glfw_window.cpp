#include "apps/terrane/window/glfw_window.h"

#define GLFW_INCLUDE_NONE  // epoxy declares OpenGL
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <chrono>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cassert>
#include <cstring>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/content/built_in.h"
#include "terrane/gpu/context.h"

// epoxy declares OpenGL; GLFW must not.
#define GLFW_INCLUDE_NONE

namespace terrane::app {

void setTerraneIcon(Window& window) {
    const auto image = content::builtInTextures()("grass_side");
    if (image) window.setIcon({image->width, image->height}, std::as_bytes(std::span(image->rgba)));
}

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
    {Key::Insert, GLFW_KEY_INSERT},
    {Key::Backspace, GLFW_KEY_BACKSPACE},
    {Key::Home, GLFW_KEY_HOME},
    {Key::End, GLFW_KEY_END},
    {Key::PageUp, GLFW_KEY_PAGE_UP},
    {Key::PageDown, GLFW_KEY_PAGE_DOWN},
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
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, options.drawsWorlds ? 4 : 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, options.drawsWorlds ? 5 : 2);
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

// Null if there is none.
GLFWmonitor* monitorOfWindow(const ScreenArea& window) {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    std::vector<ScreenArea> areas;
    for (int k = 0; k < count; ++k) {
        ScreenArea area;
        glfwGetMonitorPos(monitors[k], &area.corner.x, &area.corner.y);
        if (const GLFWvidmode* mode = glfwGetVideoMode(monitors[k])) area.size = {mode->width, mode->height};
        areas.push_back(area);
    }
    return areas.empty() ? nullptr : monitors[monitorOf(window, areas)];
}

// Adds the file's descriptions of gamepads to those that GLFW has.
void readPadMappings(const std::string& file) {
    std::error_code missing;
    if (file.empty() || !std::filesystem::exists(file, missing)) return;
    const auto text = base::readFile(file);
    if (!text) return base::logWarning("{}", text.error().message);
    // It skips wrong lines and tells them only as an error.
    const char* problem = nullptr;
    glfwUpdateGamepadMappings(text->c_str());
    if (glfwGetError(&problem) != GLFW_NO_ERROR)
        base::logWarning("{}: expected lines as in SDL's gamecontrollerdb.txt: {}", file, problem);
}

Modifiers modifiersOf(int bits) {
    return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0};
}

class GlfwWindow final : public Window {
  public:
    explicit GlfwWindow(const WindowOptions& options) {
        if (options.fullScreen) place_ = {kLeft, kTop, options.width, options.height};
    }
    ~GlfwWindow() override;
    base::Result<void> open(const WindowOptions& options);

    std::optional<glm::dvec2> cursor() const override;
    std::optional<Gamepad> gamepad() const override;
    Key keyTyping(Key letter) const override;
    void swapBuffers() override { glfwSwapBuffers(window_); }
    bool shouldClose() const override { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
    void cancelClose() override { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
    glm::ivec2 size() const override;
    glm::ivec2 framebufferSize() const override;
    float contentScale() const override;
    void setFullScreen(bool isFullScreen) override;
    void setIcon(glm::ivec2 size, std::span<const std::byte> pixels) override;
    void setVsync(Vsync vsync) override;
    void pause(double seconds) override {
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    }
    double refreshRate() const override;
    void setTextCursor(bool isOverText) override;
    std::string clipboard() const override;
    void setClipboard(const std::string& text) override { glfwSetClipboardString(window_, text.c_str()); }
    double timeSeconds() const override { return glfwGetTime(); }
    gpu::DebugLog* debugLog() const override { return debugLog_.get(); }

  private:
    void receiveEvents() override;
    void captureCursor(bool isCaptured) override;
    void installCallbacks();

    GLFWwindow* window_ = nullptr;
    GLFWcursor* textCursor_ = nullptr;
    bool isOverText_ = false;
    std::unique_ptr<gpu::DebugLog> debugLog_;
    UnknownPads unknownPads_;
    std::string padMappings_;                   // file
    glm::ivec4 place_{kLeft, kTop, 1280, 720};  // and size of the window, to restore after full screen
};

GlfwWindow::~GlfwWindow() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
}

base::Result<void> GlfwWindow::open(const WindowOptions& options) {
    if (glfwInit() == GLFW_FALSE) return base::fail("no display: {}", lastError());
    padMappings_ = options.padMappings;
    readPadMappings(padMappings_);
    window_ = openWindow(options);
    if (window_ == nullptr)
        return base::fail("no window with an OpenGL {} core context: {}", options.drawsWorlds ? "4.5" : "3.2",
                          lastError());
    glfwMakeContextCurrent(window_);
    if (options.drawsWorlds)
        if (base::Result<void> fit = gpu::checkRequirements(); !fit) return fit;
    if (options.debug) debugLog_ = gpu::enableDebugOutput(false);
    setVsync(Vsync::On);
    glfwSetTime(0.0);
    textCursor_ = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
    installCallbacks();
    return {};
}

void GlfwWindow::installCallbacks() {
    glfwSetWindowUserPointer(window_, static_cast<Window*>(this));
    static const auto of = [](GLFWwindow* window) -> Window& {
        return *static_cast<Window*>(glfwGetWindowUserPointer(window));
    };
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int code, int, int action, int modifiers) {
        if (action != GLFW_REPEAT)
            of(window).onKey(keyOfCode(code), action == GLFW_PRESS, modifiersOf(modifiers));
    });
    glfwSetCharCallback(window_,
                        [](GLFWwindow* window, unsigned character) { of(window).onCharacter(character); });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
        of(window).onMouseButton(button, action == GLFW_PRESS, modifiersOf(modifiers));
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
        of(window).onWheel({x, y});
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        of(window).onCursor({x, y});
    });
}

std::optional<glm::dvec2> GlfwWindow::cursor() const {
    const bool isHere = glfwGetWindowAttrib(window_, GLFW_FOCUSED) == GLFW_TRUE ||
                        glfwGetWindowAttrib(window_, GLFW_HOVERED) == GLFW_TRUE;
    if (!isHere) return std::nullopt;
    glm::dvec2 at(0);
    glfwGetCursorPos(window_, &at.x, &at.y);
    return at;
}

Key GlfwWindow::keyTyping(Key letter) const {
    const char typed = static_cast<char>('a' + static_cast<int>(letter) - static_cast<int>(Key::A));
    for (int code = GLFW_KEY_A; code <= GLFW_KEY_Z; ++code) {
        const char* name = glfwGetKeyName(code, 0);
        if (name != nullptr && name[0] == typed && name[1] == 0) return *keyOfCode(code);
    }
    return letter;
}

glm::ivec2 GlfwWindow::size() const {
    glm::ivec2 size(0);
    glfwGetWindowSize(window_, &size.x, &size.y);
    return size;
}

glm::ivec2 GlfwWindow::framebufferSize() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

float GlfwWindow::contentScale() const {
    float scaleX = 1.0F, scaleY = 1.0F;
    glfwGetWindowContentScale(window_, &scaleX, &scaleY);
    return scaleX;
}

void GlfwWindow::setFullScreen(bool isFullScreen) {
    if (isFullScreen == (glfwGetWindowMonitor(window_) != nullptr)) return;
    if (!isFullScreen) {
        glfwSetWindowMonitor(window_, nullptr, place_.x, place_.y, place_.z, place_.w, 0);
        return;
    }
    glfwGetWindowPos(window_, &place_.x, &place_.y);
    glfwGetWindowSize(window_, &place_.z, &place_.w);
    GLFWmonitor* monitor = monitorOfWindow({{place_.x, place_.y}, {place_.z, place_.w}});
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void GlfwWindow::setVsync(Vsync vsync) {
    const bool isAdaptive =
        vsync == Vsync::Adaptive && (glfwExtensionSupported("GLX_EXT_swap_control_tear") ||
                                     glfwExtensionSupported("WGL_EXT_swap_control_tear"));
    glfwSwapInterval(isAdaptive ? -1 : vsync == Vsync::Off ? 0 : 1);
}

double GlfwWindow::refreshRate() const {
    glm::ivec2 position{0};
    glfwGetWindowPos(window_, &position.x, &position.y);
    GLFWmonitor* monitor = monitorOfWindow({position, size()});
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    return mode != nullptr ? mode->refreshRate : 0;
}

void GlfwWindow::setIcon(glm::ivec2 size, std::span<const std::byte> pixels) {
    assert(pixels.size() ==
           std::size_t{4} * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    std::vector<unsigned char> copy(pixels.size());  // GLFW takes a writable pointer
    std::memcpy(copy.data(), pixels.data(), pixels.size());
    const GLFWimage image{size.x, size.y, copy.data()};
    glfwSetWindowIcon(window_, 1, &image);
}

void GlfwWindow::setTextCursor(bool isOverText) {
    if (std::exchange(isOverText_, isOverText) == isOverText) return;
    glfwSetCursor(window_, isOverText ? textCursor_ : nullptr);
}

std::string GlfwWindow::clipboard() const {
    const char* text = glfwGetClipboardString(window_);
    return text != nullptr ? text : "";
}

void GlfwWindow::receiveEvents() {
    glfwPollEvents();
    std::vector<UnknownPads::Joystick> joysticks;
    for (int k = GLFW_JOYSTICK_1; k <= GLFW_JOYSTICK_LAST; ++k) {
        const char* guid = glfwJoystickPresent(k) == GLFW_TRUE ? glfwGetJoystickGUID(k) : nullptr;
        const char* name = guid != nullptr ? glfwGetJoystickName(k) : nullptr;
        if (name != nullptr) joysticks.push_back({guid, name, glfwJoystickIsGamepad(k) == GLFW_TRUE});
    }
    for (const std::string& line : unknownPads_.take(joysticks, padMappings_)) base::logWarning("{}", line);
}

void GlfwWindow::captureCursor(bool isCaptured) {
    glfwSetInputMode(window_, GLFW_CURSOR, isCaptured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

std::optional<Gamepad> GlfwWindow::gamepad() const {
    GLFWgamepadstate state;
    int first = GLFW_JOYSTICK_1;  // that is a gamepad: pedals and sticks may come before it
    while (first <= GLFW_JOYSTICK_LAST && glfwGetGamepadState(first, &state) == GLFW_FALSE) ++first;
    if (first > GLFW_JOYSTICK_LAST) return std::nullopt;
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
                   isDown(GLFW_GAMEPAD_BUTTON_START),
                   isDown(GLFW_GAMEPAD_BUTTON_BACK),
                   isDown(GLFW_GAMEPAD_BUTTON_LEFT_THUMB),
                   isDown(GLFW_GAMEPAD_BUTTON_RIGHT_THUMB)};
}

}  // namespace

base::Result<std::unique_ptr<Window>> openGlfwWindow(const WindowOptions& options) {
    assert(options.width > 0 && options.height > 0 && "a window has a size");
    auto window = std::make_unique<GlfwWindow>(options);
    TERRANE_TRY(window->open(options));
    return window;
}

}  // namespace terrane::app
