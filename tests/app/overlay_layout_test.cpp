// The rule of overlays, with random ones; tests/window/overlays_test.cpp has those of the program.
#include "apps/terrane/window/hud/overlay_layout.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace terrane::app {
namespace {

class OverlayLayoutTest : public testing::Test {
  protected:
    OverlayLayoutTest() : context_(ImGui::CreateContext()) {
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~OverlayLayoutTest() override { ImGui::DestroyContext(context_); }

    static void beginFrame(const Screen& screen) {
        ImGui::GetIO().DisplaySize = {screen.width, screen.height};
        ImGui::NewFrame();
    }

  private:
    ImGuiContext* context_;
};

TEST_F(OverlayLayoutTest, OverlaysAreOnTheScreenAndApart) {
    std::mt19937 random(3);
    const auto upTo = [&](float most) { return std::uniform_real_distribution<float>(0, most)(random); };
    for (int round = 0; round < 2000; ++round) {
        const Screen screen{40 + upTo(2000), 20 + upTo(1200)};
        beginFrame(screen);
        OverlayLayout layout(screen);
        std::vector<OverlayRect> placed;
        for (int k = 0; k < 15; ++k) {
            const OverlayPlace wanted{.size = {upTo(700), upTo(400)},
                                      .alignX = static_cast<float>(random() % 3) / 2,
                                      .top = upTo(1.2f * screen.height) - 20,
                                      .minHeight = random() % 2 == 0 ? 0 : 20.0f};
            const auto rect = layout.place("any", wanted);
            if (!rect) continue;
            EXPECT_TRUE(rect->min.x >= 0 && rect->min.y >= 0 && rect->max.x <= screen.width &&
                        rect->max.y <= screen.height);
            EXPECT_LE(rect->height(), wanted.size.y + 0.01f);
            const bool isCut = rect->height() < wanted.size.y - 0.01f;
            EXPECT_TRUE(!isCut || (wanted.minHeight > 0 && rect->height() >= wanted.minHeight));
            for (const OverlayRect& other : placed) ASSERT_FALSE(rect->overlaps(other)) << round;
            placed.push_back(*rect);
        }
        EXPECT_FALSE(placed.empty() && screen.width > 100 && screen.height > 500);
        ImGui::EndFrame();
    }
}

TEST_F(OverlayLayoutTest, AnOverlayMovesNoFartherThanItMust) {
    beginFrame({800, 600});
    OverlayLayout layout({800, 600});
    const OverlayPlace wanted{.size = {100, 50}, .alignX = 0.5f, .top = 200};
    const auto first = layout.place("first", wanted), second = layout.place("second", wanted);
    EXPECT_EQ(first->min.y, 200);
    EXPECT_NEAR(std::abs(second->min.y - first->min.y), 54, 1) << "just beside it";
    const auto beside = layout.place("beside", {.size = {100, 50}, .top = 200});
    EXPECT_EQ(beside->min.y, 200) << "another column";
    EXPECT_FALSE(layout.placeAt("there", {{400, 220}, {420, 230}}));
    EXPECT_TRUE(layout.placeAt("free", {{400, 400}, {420, 430}}));
    EXPECT_FALSE(layout.place("near", {.size = {100, 50}, .alignX = 0.5f, .top = 200, .reach = 20}));
    EXPECT_FALSE(layout.place("too high", {.size = {800, 580}})) << "it must not be cut";
    const auto cut = layout.place("cut", {.size = {100, 580}, .minHeight = 50});
    EXPECT_NEAR(cut->height(), 600 - 8 - 254, 2) << "the highest gap of the column";
    ImGui::EndFrame();
}

TEST_F(OverlayLayoutTest, DialogsAreKeptClear) {
    for (int frame = 0; frame < 3; ++frame) {
        beginFrame({800, 600});
        OverlayLayout layout({800, 600});
        const auto rect = layout.place("hud", {.size = {100, 50}, .alignX = 0.5f, .top = 250});
        EXPECT_TRUE(frame == 0 || rect->max.y <= 200 || rect->min.y >= 400) << "the frame after it opened";
        ImGui::SetNextWindowPos({200, 200});
        ImGui::SetNextWindowSize({400, 200});
        ImGui::Begin("dialog");
        ImGui::End();
        ImGui::EndFrame();
    }
}

// A window has the size of its contents, and a scroll bar where it is cut.
TEST_F(OverlayLayoutTest, WindowsAreAsLargeAsTheirContents) {
    for (const float height : {600.0f, 120.0f})
        for (int frame = 0; frame < 4; ++frame) {
            beginFrame({800, height});
            OverlayLayout layout({800, height});
            if (layout.beginWindow({.title = "lines", .id = "lines"}, {.alignX = 1, .minHeight = 30})) {
                for (int k = 0; k < 12; ++k) ImGui::Text("line %d", k);
                const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
                if (frame > 1) {
                    EXPECT_LE(at.x + size.x, 800);
                    EXPECT_LE(at.y + size.y, height);
                    EXPECT_EQ(ImGui::GetScrollMaxY() > 0, height < 300);
                }
                ImGui::End();
            }
            ImGui::EndFrame();
        }
}

}  // namespace
}  // namespace terrane::app
