#include "apps/terrane/window/screenshot_view.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <span>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/thumbnail.h"

namespace terrane::app {
namespace {

constexpr double kSeconds = 3;
constexpr float kWidth = 192;  // before scaling

}  // namespace

void ScreenshotView::show(const base::Image& screenshot) {
    const base::Image small = thumbnailFrom(screenshot);
    image_ = gpu::Texture2D({small.width, small.height}, GL_RGBA8, 1, "screenshot");
    image_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(small.rgba)));
    secondsLeft_ = kSeconds;
}

void ScreenshotView::advance(double seconds) {
    if (secondsLeft_ <= 0) return;
    secondsLeft_ -= seconds;
    if (secondsLeft_ <= 0) image_ = {};
}

void ScreenshotView::draw(const Screen& screen) const {
    if (image_.id() == 0) return;
    const float alpha = static_cast<float>(std::min(secondsLeft_, 1.0)), margin = 10 * uiScale();
    const float width = kWidth * uiScale();
    const ImVec2 size(width,
                      width * static_cast<float>(image_.size().y) / static_cast<float>(image_.size().x));
    const ImVec2 max(screen.width - margin, margin + size.y), min(max.x - size.x, margin);
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    const int opacity = static_cast<int>(255 * alpha);
    draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image_.id())), min, max, {0, 0},
                  {1, 1}, IM_COL32(255, 255, 255, opacity));
    draw.AddRect(min, max, IM_COL32(255, 255, 255, opacity), 0, 0, 2 * uiScale());
}

}  // namespace terrane::app
