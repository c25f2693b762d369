#include "apps/terrane/window/game/pictures.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <span>

#include "apps/terrane/window/imgui_layer.h"
#include "terrane/base/log.h"

namespace terrane::app {

namespace {

// Pixels of an image, the end excluded; not empty.
struct Part {
    int x0, y0, x1, y1;
};

void writeMean(const base::Image& image, const Part& part, std::uint8_t* out) {
    const auto [x0, y0, x1, y1] = part;
    unsigned sums[4] = {};
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                        static_cast<std::size_t>(x));
            for (std::size_t k = 0; k < 4; ++k) sums[k] += image.rgba[at + k];
        }
    }
    const auto count = static_cast<unsigned>((x1 - x0) * (y1 - y0));
    for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<std::uint8_t>(sums[k] / count);
}

}  // namespace

base::Image thumbnailFrom(const base::Image& image) {
    if (image.width <= 0 || image.height <= 0) return {};
    const int usedWidth =
        std::max(1, std::min(image.width, image.height * kThumbnailWidth / kThumbnailHeight));
    const int usedHeight =
        std::max(1, std::min(image.height, usedWidth * kThumbnailHeight / kThumbnailWidth));
    base::Image small{std::min(usedWidth, kThumbnailWidth), std::min(usedHeight, kThumbnailHeight), {}};
    small.rgba.resize(4 * static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height));
    const int left = (image.width - usedWidth) / 2, top = (image.height - usedHeight) / 2;
    std::uint8_t* out = small.rgba.data();
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x, out += 4) {
            const int x0 = left + x * usedWidth / small.width, y0 = top + y * usedHeight / small.height;
            const int x1 = left + (x + 1) * usedWidth / small.width;
            const int y1 = top + (y + 1) * usedHeight / small.height;
            writeMean(image, {x0, y0, std::max(x1, x0 + 1), std::max(y1, y0 + 1)}, out);
        }
    }
    return small;
}

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

void ScreenshotView::draw(OverlayLayout& layout) const {
    if (image_.id() == 0) return;
    const float alpha = static_cast<float>(std::min(secondsLeft_, 1.0));
    const float width = std::min(kWidth * uiScale(), layout.widest());
    const float height = width * static_cast<float>(image_.size().y) / static_cast<float>(image_.size().x);
    const auto rect = layout.place("screenshot", {.size = {width, height}, .alignX = 1});
    if (!rect) return;
    const ImVec2 min = rect->min, max = rect->max;
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    const OverlayClip clip(draw, *rect);
    const int opacity = static_cast<int>(255 * alpha);
    draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image_.id())), min, max, {0, 0},
                  {1, 1}, IM_COL32(255, 255, 255, opacity));
    draw.AddRect(min, max, IM_COL32(255, 255, 255, opacity), 0, 0, 2 * uiScale());
}

namespace {

// The first free name of the form terrane-0001.png.
std::filesystem::path freeScreenshot(const std::filesystem::path& folder) {
    for (int number = 1;; ++number) {
        const std::filesystem::path path = folder / fmt::format("terrane-{:04}.png", number);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace

base::Result<std::filesystem::path> writeScreenshot(const std::filesystem::path& folder,
                                                    const base::Image& image) {
    std::error_code ignored;  // writePng() reports errors
    std::filesystem::create_directories(folder, ignored);
    const std::filesystem::path file = freeScreenshot(folder);
    TERRANE_TRY(base::writePng(file, image));
    return file;
}

void writeThumbnail(const std::filesystem::path& file, const base::Image& image) {
    const auto done = base::writePng(file, thumbnailFrom(image));
    if (!done) base::logInfo("{}", done.error().message);
}

}  // namespace terrane::app
