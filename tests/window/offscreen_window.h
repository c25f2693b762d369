// A window without a screen or a window library, for tests. Frames are drawn into a framebuffer; a test makes
// the events, and time passes only from frame to frame.
#pragma once

#include <functional>

#include "apps/terrane/window/widgets.h"
#include "apps/terrane/window/window.h"
#include "terrane/gpu/context.h"

namespace terrane::app {

class OffscreenWindow final : public Window {
  public:
    static constexpr double kFrameSeconds = 1.0 / 20;
    static constexpr glm::ivec2 kScreen{640, 400};  // size in full screen

    // `nextFrame` is called when the program polls events, and makes them. Called on the thread that uses the
    // window.
    static base::Result<std::unique_ptr<OffscreenWindow>> create(const WindowOptions& options,
                                                                 std::function<void()> nextFrame);

    std::optional<glm::dvec2> cursor() const override { return cursorAt; }
    std::optional<Gamepad> gamepad() const override { return pad; }
    void swapBuffers() override { ++framesDrawn; }
    bool shouldClose() const override { return isClosed; }
    void cancelClose() override { isClosed = false; }
    glm::ivec2 size() const override { return isFullScreen ? kScreen : units; }
    glm::ivec2 framebufferSize() const override;
    float contentScale() const override { return scale; }
    void setFullScreen(bool isFull) override { isFullScreen = isFull; }
    void setIcon(glm::ivec2, std::span<const std::byte> pixels) override { hasIcon = !pixels.empty(); }
    void setVsync(Vsync given) override { vsync = given; }
    void pause(double given) override { pausedSeconds += given; }
    double refreshRate() const override { return 60; }
    void setTextCursor(bool isOverText) override { hasTextCursor = isOverText; }
    std::string clipboard() const override { return clipboardText; }
    void setClipboard(const std::string& text) override { clipboardText = text; }
    double timeSeconds() const override { return seconds; }
    gpu::DebugLog* debugLog() const override { return context_.debugLog(); }
    WidgetRecord* widgets() override { return &record; }

    // Set and read by the test between two frames.
    glm::ivec2 units{0};
    float scale = 1, unitPixels = 1;  // of the interface; pixels per unit
    bool isMinimised = false, isFullScreen = false, isClosed = false, isCaptured = false;
    bool hasIcon = false, hasTextCursor = false;
    Vsync vsync = Vsync::On;
    double pausedSeconds = 0;
    std::optional<glm::dvec2> cursorAt;
    std::optional<Gamepad> pad;
    std::string clipboardText;
    double seconds = 0;
    int framesDrawn = 0;
    WidgetRecord record;

  private:
    explicit OffscreenWindow(std::function<void()> nextFrame) : nextFrame_(std::move(nextFrame)) {}
    void receiveEvents() override;
    void captureCursor(bool captures) override { isCaptured = captures; }

    gpu::HeadlessContext context_;
    glm::ivec2 surface_{0};  // size of the framebuffer
    std::function<void()> nextFrame_;
};

}  // namespace terrane::app
