// Writes images of the window: screenshots, and the world's thumbnail for the list of worlds.
#pragma once

#include <filesystem>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/gpu/texture.h"

namespace terrane::app {

// The image of a world in the list of worlds. Any thread.
constexpr int kThumbnailWidth = 320, kThumbnailHeight = 180;

// The middle of an image, cropped to the aspect of a thumbnail and reduced: each pixel is the mean of those
// that it covers. Smaller images are not enlarged.
base::Image thumbnailFrom(const base::Image& image);

// Shows a small copy of the last screenshot for some seconds. Immediate mode: drawn each frame.
class ScreenshotView {
  public:
    // Keeps a small copy.
    void show(const base::Image& screenshot);
    void advance(double seconds);
    void draw(OverlayLayout& layout) const;
    bool isShown() const { return secondsLeft_ > 0; }

  private:
    gpu::Texture2D image_;
    double secondsLeft_ = 0;
};

// Writes a new file in the folder, creating the folder if needed; returns its path.
base::Result<std::filesystem::path> writeScreenshot(const std::filesystem::path& folder,
                                                    const base::Image& image);

// Overwrites the last thumbnail. A failure is only logged.
void writeThumbnail(const std::filesystem::path& file, const base::Image& image);

}  // namespace terrane::app
