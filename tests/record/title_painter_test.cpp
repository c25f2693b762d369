#include "apps/terrane/record/title_painter.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

constexpr int kWidth = 640, kHeight = 360;

base::Image grey() {
    return {kWidth, kHeight, std::vector<std::uint8_t>(std::size_t{4} * kWidth * kHeight, 128)};
}

struct Changed {
    int left = kWidth, right = -1, top = kHeight, bottom = -1, white = 0;
};

Changed changedBy(std::string_view text, bool isLarge, float strength = 1) {
    base::Image image = grey();
    TitlePainter(kHeight).paint(image, text, isLarge, strength);
    Changed changed;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::uint8_t value = image.rgba[4 * static_cast<std::size_t>(y * kWidth + x)];
            EXPECT_EQ(image.rgba[4 * static_cast<std::size_t>(y * kWidth + x) + 3], 128) << "alpha";
            if (value == 128) continue;
            changed.left = std::min(changed.left, x);
            changed.right = std::max(changed.right, x);
            changed.top = std::min(changed.top, y);
            changed.bottom = std::max(changed.bottom, y);
            changed.white += value == 255;
        }
    }
    return changed;
}

TEST(TitlePainter, LargeTitlesAreInTheMiddle) {
    const Changed c = changedBy("HOH", true);
    EXPECT_GT(c.white, 100);
    EXPECT_NEAR((c.left + c.right) / 2.0, kWidth / 2.0, 8);
    EXPECT_NEAR((c.top + c.bottom) / 2.0, kHeight / 2.0, 12);
    EXPECT_GT(c.bottom - c.top, 20);
}

TEST(TitlePainter, SmallTitlesAreAtTheBottom) {
    const Changed c = changedBy("HOH", false);
    EXPECT_GT(c.white, 20);
    EXPECT_NEAR((c.left + c.right) / 2.0, kWidth / 2.0, 4);
    EXPECT_GT(c.top, kHeight * 0.8);
    EXPECT_LT(c.bottom, kHeight * 0.96);
}

TEST(TitlePainter, LinesGoBelowEachOther) {
    const Changed one = changedBy("HOH", false), two = changedBy("HOH\nHOH", false);
    EXPECT_LT(two.top, one.top - 10);
    EXPECT_EQ(two.left, one.left);
    EXPECT_EQ(two.white, 2 * one.white);
}

TEST(TitlePainter, LongTitlesStayInTheImage) {
    const Changed c = changedBy(std::string(300, 'W'), true);
    EXPECT_EQ(c.left, 0);
    EXPECT_EQ(c.right, kWidth - 1);
}

TEST(TitlePainter, AFadedTitleIsLessThanWhite) {
    EXPECT_EQ(changedBy("HOH", true, 0.5f).white, 0);
    EXPECT_EQ(changedBy("HOH", true, 0).right, -1) << "nothing changes";
}

TEST(TitlePainter, KnowsWhichLettersItHas) {
    EXPECT_EQ(TitlePainter::missingLetter("Hello, \u00fc\n\u00df!"), "");
    EXPECT_EQ(TitlePainter::missingLetter("a \u2013 b"), "\u2013");
    EXPECT_EQ(TitlePainter::missingLetter("a\tb"), "\t");
}

}  // namespace
}  // namespace terrane::app
