// Draws titles into images on the CPU, with the font of Dear ImGui (ISO 8859-1): the same pixels on every
// machine. One thread.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "terrane/base/image.h"

struct ImFont;
struct ImFontAtlas;

namespace terrane::app {

class TitlePainter {
  public:
    // The size of letters follows from the image's height.
    explicit TitlePainter(int imageHeight);
    ~TitlePainter();

    // The first letter of the text that the font lacks, as UTF-8; empty if it has all.
    static std::string missingLetter(std::string_view text);

    // Lines are centered: large in the middle of the image, or small at the bottom. `strength`: 0…1.
    void paint(base::Image& image, std::string_view text, bool isLarge, float strength) const;

  private:
    std::unique_ptr<ImFontAtlas> atlas_;
    ImFont *small_ = nullptr, *large_ = nullptr;
};

}  // namespace terrane::app
