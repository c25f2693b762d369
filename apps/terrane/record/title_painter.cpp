#include "apps/terrane/record/title_painter.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace terrane::app {
namespace {

// Shares of the image's height.
constexpr float kSmall = 0.042f, kLarge = 0.11f, kBottomMargin = 0.07f;
constexpr float kLetterSize = 13;  // pixels of Dear ImGui's font; other sizes are whole multiples

std::vector<unsigned> lettersOf(std::string_view text) {
    std::vector<unsigned> letters;
    for (const char *at = text.data(), *end = at + text.size(); at < end;) {
        unsigned letter = 0;
        at += std::max(1, ImTextCharFromUtf8(&letter, at, end));
        letters.push_back(letter);
    }
    return letters;
}

std::vector<std::vector<unsigned>> linesOf(std::string_view text) {
    std::vector<std::vector<unsigned>> lines(1);
    for (const unsigned letter : lettersOf(text)) {
        if (letter == '\n') {
            lines.emplace_back();
        } else {
            lines.back().push_back(letter);
        }
    }
    return lines;
}

ImFont* addFont(ImFontAtlas& atlas, float size) {
    ImFontConfig config;
    config.OversampleH = config.OversampleV = 1;  // a texel is a pixel
    config.PixelSnapH = true;
    config.SizePixels = kLetterSize * std::max(1.0f, std::round(size / kLetterSize));
    return atlas.AddFontDefault(&config);
}

// Coverage of image pixels by the letters of a text, 0…255 each.
struct Cover {
    int width, height;
    std::vector<std::uint8_t> values;

    void raise(int x, int y, std::uint8_t value) {
        if (x < 0 || y < 0 || x >= width || y >= height) return;
        std::uint8_t& at = values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(x)];
        at = std::max(at, value);
    }
};

class LetterPainter {
  public:
    explicit LetterPainter(ImFontAtlas& atlas) { atlas.GetTexDataAsAlpha8(&pixels_, &width_, &height_); }

    void paint(Cover& cover, const ImFontGlyph& glyph, int x, int y) const {
        const int fromX = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(width_)));
        const int fromY = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(height_)));
        const int toX = static_cast<int>(std::lround(glyph.U1 * static_cast<float>(width_)));
        const int toY = static_cast<int>(std::lround(glyph.V1 * static_cast<float>(height_)));
        const int left = x + static_cast<int>(std::lround(glyph.X0));
        const int top = y + static_cast<int>(std::lround(glyph.Y0));
        for (int v = fromY; v < toY; ++v)
            for (int u = fromX; u < toX; ++u)
                cover.raise(left + u - fromX, top + v - fromY, pixels_[v * width_ + u]);
    }

  private:
    unsigned char* pixels_ = nullptr;
    int width_ = 0, height_ = 0;
};

float widthOf(const ImFont& font, const std::vector<unsigned>& line) {
    float width = 0;
    for (const unsigned letter : line) width += font.FindGlyph(static_cast<ImWchar>(letter))->AdvanceX;
    return width;
}

// A shadow around the letters, for contrast on a bright image.
Cover shadowOf(const Cover& letters, int reach) {
    Cover shadow{letters.width, letters.height, std::vector<std::uint8_t>(letters.values.size())};
    for (int y = 0; y < letters.height; ++y) {
        for (int x = 0; x < letters.width; ++x) {
            const std::uint8_t value = letters.values[static_cast<std::size_t>(y * letters.width + x)];
            if (value == 0) continue;
            for (int dy = -reach; dy <= reach; ++dy)
                for (int dx = -reach; dx <= reach; ++dx) {
                    const double distance = std::hypot(dx, dy) / (reach + 1);
                    if (distance < 1)
                        shadow.raise(x + dx, y + dy, static_cast<std::uint8_t>(value * (1 - distance)));
                }
        }
    }
    return shadow;
}

void blend(base::Image& image, const Cover& cover, int top, float brightness, float strength) {
    for (int y = 0; y < cover.height; ++y) {
        if (y + top < 0 || y + top >= image.height) continue;
        for (int x = 0; x < cover.width; ++x) {
            const auto from = static_cast<std::size_t>(y * cover.width + x);
            const auto to = 4 * static_cast<std::size_t>((y + top) * cover.width + x);
            const float share = static_cast<float>(cover.values[from]) / 255.0f * strength;
            for (std::size_t c = 0; c < 3; ++c) {
                const float before = image.rgba[to + c];
                image.rgba[to + c] = static_cast<std::uint8_t>(before + (brightness - before) * share + 0.5f);
            }
        }
    }
}

}  // namespace

TitlePainter::TitlePainter(int imageHeight) : atlas_(std::make_unique<ImFontAtlas>()) {
    const auto height = static_cast<float>(imageHeight);
    small_ = addFont(*atlas_, kSmall * height);
    large_ = addFont(*atlas_, kLarge * height);
    atlas_->Build();
}

TitlePainter::~TitlePainter() = default;

std::string TitlePainter::missingLetter(std::string_view text) {
    for (const unsigned letter : lettersOf(text)) {
        if (letter == '\n' || (letter >= 0x20 && letter < 0x7F) || (letter >= 0xA0 && letter <= 0xFF))
            continue;
        std::array<char, 5> utf8{};
        return ImTextCharToUtf8(utf8.data(), letter);
    }
    return {};
}

void TitlePainter::paint(base::Image& image, std::string_view text, bool isLarge, float strength) const {
    assert(image.width > 0 && image.height > 0 && "frames have pixels");
    const ImFont& font = isLarge ? *large_ : *small_;
    const LetterPainter letters(*atlas_);
    const auto lines = linesOf(text);
    const float step = font.FontSize * 1.25f;
    const int reach = std::max(1, static_cast<int>(font.FontSize * 0.1f));
    const int height = static_cast<int>(step * static_cast<float>(lines.size())) + 2 * reach;
    Cover cover{
        image.width, height,
        std::vector<std::uint8_t>(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(height))};
    for (std::size_t n = 0; n < lines.size(); ++n) {
        float x = std::floor((static_cast<float>(image.width) - widthOf(font, lines[n])) / 2);
        const int y = reach + static_cast<int>(step * static_cast<float>(n));
        for (const unsigned letter : lines[n]) {
            const ImFontGlyph& glyph = *font.FindGlyph(static_cast<ImWchar>(letter));
            letters.paint(cover, glyph, static_cast<int>(std::lround(x)), y);
            x += glyph.AdvanceX;
        }
    }
    const int bottom = static_cast<int>(kBottomMargin * static_cast<float>(image.height));
    const int top = isLarge ? (image.height - height) / 2 : image.height - bottom - height;
    blend(image, shadowOf(cover, reach), top, 0, 0.8f * strength);
    blend(image, cover, top, 255, strength);
}

}  // namespace terrane::app
