// Shows a small copy of the last screenshot for some seconds. Immediate mode: drawn each frame.
#pragma once

#include "apps/terrane/window/overlay.h"
#include "terrane/base/image.h"
#include "terrane/gpu/texture.h"

namespace terrane::app {

class ScreenshotView {
  public:
    // Keeps a small copy.
    void show(const base::Image& screenshot);
    void advance(double seconds);
    void draw(const Screen& screen) const;
    bool isShown() const { return secondsLeft_ > 0; }

  private:
    gpu::Texture2D image_;
    double secondsLeft_ = 0;
};

}  // namespace terrane::app
