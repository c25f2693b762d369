#include "tests/window/offscreen_window.h"

#include <stdexcept>

namespace terrane::app {

base::Result<std::unique_ptr<OffscreenWindow>> OffscreenWindow::create(const WindowOptions& options,
                                                                       std::function<void()> nextFrame) {
    auto context = gpu::HeadlessContext::create({.debug = options.debug});
    if (!context) return tl::unexpected(context.error());
    std::unique_ptr<OffscreenWindow> window(new OffscreenWindow(std::move(nextFrame)));
    window->context_ = std::move(*context);
    window->units = {options.width, options.height};
    window->isFullScreen = options.fullScreen;
    window->surface_ = window->framebufferSize();
    if (auto set = window->context_.setSurface(window->surface_.x, window->surface_.y); !set)
        return tl::unexpected(set.error());
    return window;
}

glm::ivec2 OffscreenWindow::framebufferSize() const {
    return isMinimised ? glm::ivec2(0) : glm::ivec2(glm::vec2(size()) * unitPixels);
}

void OffscreenWindow::receiveEvents() {
    nextFrame_();
    seconds += kFrameSeconds;
    const glm::ivec2 pixels = framebufferSize();
    if (pixels.x == 0 || pixels == surface_) return;
    surface_ = pixels;
    if (auto set = context_.setSurface(pixels.x, pixels.y); !set)
        throw std::runtime_error(set.error().message);
}

}  // namespace terrane::app
