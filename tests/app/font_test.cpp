#include "apps/terrane/window/imgui_layer.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace terrane::app {
namespace {

class Font : public testing::Test {
  protected:
    void SetUp() override { ImGui::CreateContext(); }
    void TearDown() override { ImGui::DestroyContext(); }

    // Makes the font as ImguiLayer does.
    static const ImFont& made(const std::string& file) {
        addFont(13, file);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        replaceMissingLetters();
        return *ImGui::GetIO().Fonts->Fonts[0];
    }
};

TEST_F(Font, TheSystemsFontHasTheLettersOfAllLanguages) {
    const std::string file = fontFile();
    if (file.empty()) GTEST_SKIP() << "no DejaVu Sans on this system";
    const ImFont& font = made(file);
    for (const ImWchar letter : {0x11B, 0x159, 0x16F, 0xDF, 0x201E, 0x2026})
        EXPECT_NE(font.FindGlyphNoFallback(letter), nullptr) << letter;
    EXPECT_NE(font.FindGlyph(0x11B)->U0, font.FindGlyph('e')->U0);
}

TEST_F(Font, WithoutItLettersLoseTheirAccents) {
    const ImFont& font = made("");
    for (const auto& [letter, plain] : {std::pair(0x11B, 'e'), {0x158, 'R'}, {0x201E, '"'}}) {
        const ImFontGlyph* shown = font.FindGlyphNoFallback(static_cast<ImWchar>(letter));
        ASSERT_NE(shown, nullptr) << plain;
        EXPECT_EQ(shown->U0, font.FindGlyph(static_cast<ImWchar>(plain))->U0) << plain;
    }
}

}  // namespace
}  // namespace terrane::app
