// No overlay covers another one: with all of them, in windows of all sizes and with all sizes of text.
#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <functional>
#include <set>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "tests/window/server_fixture.h"

namespace terrane::app {
namespace {

struct Area {
    std::string name;
    OverlayRect rect;
    bool isOverlay = false;
};

// All overlays, and windows that are no overlays, such as dialogs.
std::vector<Area> areasOf(Program& program) {
    std::vector<Area> areas;
    for (const Widget& widget : program.window().record.widgets())
        if (widget.label == "overlay") areas.push_back({widget.value, {widget.min, widget.max}, true});
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        const bool isPart = (window->Flags & (ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Tooltip)) != 0;
        const bool isOverlay = std::string_view(window->Name).find("###overlay") != std::string_view::npos;
        const ImRect rect = window->Rect();
        if (window->Active && !window->Hidden && !window->IsFallbackWindow && !isPart && !isOverlay)
            areas.push_back({window->Name, {rect.Min, rect.Max}, false});
    }
    return areas;
}

std::set<std::string> overlaysOf(Program& program) {
    std::set<std::string> names;
    for (const Widget& widget : program.window().record.widgets())
        if (widget.label == "overlay") names.insert(widget.value);
    return names;
}

void expectApart(Program& program, const std::string& what) {
    const std::vector<Area> areas = areasOf(program);
    const auto [width, height] = ImGui::GetIO().DisplaySize;
    for (std::size_t k = 0; k < areas.size(); ++k) {
        const OverlayRect& rect = areas[k].rect;
        const bool isInside =
            rect.min.x >= 0 && rect.min.y >= 0 && rect.max.x <= width && rect.max.y <= height;
        EXPECT_TRUE(isInside || !areas[k].isOverlay)
            << what << ": " << areas[k].name << " is not on the screen";
        for (std::size_t n = 0; n < k; ++n)
            EXPECT_FALSE(rect.overlaps(areas[n].rect))
                << what << ": " << areas[k].name << " covers " << areas[n].name;
    }
    // What a window shows is where the layout has it.
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        const std::string_view name(window->Name);
        const std::size_t mark = name.find("###overlay ");
        if (!window->Active || window->Hidden || mark == name.npos) continue;
        const auto found = std::ranges::find(areas, name.substr(mark + 11), &Area::name);
        ASSERT_NE(found, areas.end()) << what << ": " << name;
        EXPECT_LE(window->Pos.x + window->Size.x, found->rect.max.x + 1) << what << ": " << name;
        EXPECT_LE(window->Pos.y + window->Size.y, found->rect.max.y + 1) << what << ": " << name;
    }
}

// Messages, help and the small copy of a screenshot stay for the test.
void keepNotices(Program& program) {
    program.press(Key::F12);
    program.game().notices.say("screenshot /home/player/.local/share/terrane/screenshots/terrane-0001.png",
                               1e6);
    program.game().notices.helpSeconds = 1e6;
}

// Windows from 320×180 to 4K, and text from half to double size; few pixels, since only the layout counts.
void forEachScreen(Program& program, const std::function<void(const std::string&)>& look) {
    constexpr glm::ivec2 kSizes[] = {{320, 180},  {480, 300},   {640, 360},
                                     {1280, 720}, {1920, 1080}, {3840, 2160}};
    for (const glm::ivec2 size : kSizes)
        for (const float textSize : {0.5f, 1.0f, 2.0f}) {
            OffscreenWindow& window = program.window();
            window.units = size;
            window.unitPixels = window.scale = size.x > 640 ? 640.0f / static_cast<float>(size.x) : 1.0f;
            program.game().settings.textSize = textSize;
            program.frames(3);
            keepNotices(program);
            look(fmt::format("{}x{}, text {}", size.x, size.y, textSize));
        }
}

using OverlaysTest = ServerTest;

TEST_F(OverlaysTest, NothingCoversAnythingInAWorld) {
    makeWorld("home", {{"camera", "8.5 8.5 84 0 -20"}, {"movement", "fast"}, {"hotbar", "0 bricks"}});
    Program program = play("home");
    program.untilDrawn();
    program.tap(MouseButton::Left);
    for (const Key key : {Key::F2, Key::F7, Key::F4}) program.press(key);
    program.tap(MouseButton::Left);
    program.press(Key::B);
    program.tap(MouseButton::Left, {.shift = true});
    program.game().hud.places = {{"The old mill", {.position = {900, 8, 90}}}};
    std::filesystem::rename(worldFile("home"), folder() / "away.sqlite");
    program.widget("overlay", "save notice");
    forEachScreen(program, [&](const std::string& what) { expectApart(program, what); });
    // With room for all.
    program.game().settings.textSize = 1;
    program.frames(3);
    for (const char* name : {"save notice", "hotbar", "compass", "position", "selection", "message", "panel",
                             "statistics", "screenshot", "help"})
        EXPECT_TRUE(overlaysOf(program).contains(name)) << name;
    // Dialogs are over none.
    program.press(Key::Tab);
    forEachScreen(program, [&](const std::string& what) { expectApart(program, "palette, " + what); });
    program.window().units = {800, 500};
    program.window().unitPixels = program.window().scale = 0.8f;
    program.game().settings.textSize = 1;
    program.frames(3);
    EXPECT_TRUE(overlaysOf(program).contains("hotbar")) << "digits put blocks into its slots";
    program.press(Key::Escape);
    program.press(Key::Escape);
    program.press(Key::Escape);
    program.press(Key::Escape);
    program.widget("Settings");
    forEachScreen(program, [&](const std::string& what) { expectApart(program, "menu, " + what); });
    std::filesystem::rename(folder() / "away.sqlite", worldFile("home"));
    program.until("saving works", [&] { return !program.isShown("overlay", "save notice"); });
}

TEST_F(OverlaysTest, NothingCoversAnythingOnAServer) {
    Program program = start({"--connect", server_->address(), "--name", "Ann", "--movement", "fast"});
    program.beforeFrame = [&] { server_->update(); };
    program.until("the player has joined", [&] { return program.isPlaying() && program.game().remote.play; });
    program.untilDrawn();
    for (const Key key : {Key::F2, Key::F7}) program.press(key);
    program.tap(MouseButton::Left);
    program.press(Key::B);
    program.press(Key::Y);
    program.widget("Players");
    for (int k = 0; k < 40; ++k)
        program.game().remote.chat.add({"Bob", fmt::format("line {} {}", k, std::string(80, 'x'))},
                                       program.game().seconds);
    program.press(Key::T);
    program.widget("##chat");
    forEachScreen(program, [&](const std::string& what) { expectApart(program, what); });
    program.game().settings.textSize = 1;
    program.frames(3);
    for (const char* name : {"hotbar", "compass", "position", "selection", "message", "chat", "chat input"})
        EXPECT_TRUE(overlaysOf(program).contains(name)) << name;
    program.press(Key::Escape);
}

// The crosshair is there while nothing covers the middle.
TEST_F(OverlaysTest, TheCrosshairKeepsClear) {
    makeWorld("home", {{"camera", "8.5 8.5 84 0 -20"}, {"movement", "fast"}});
    Program program = play("home", {"--size", "640x400"});
    program.untilDrawn();
    program.tap(MouseButton::Left);
    program.game().notices.helpSeconds = 0;
    program.frames(2);
    EXPECT_TRUE(overlaysOf(program).contains("crosshair"));
    program.press(Key::F4);
    EXPECT_TRUE(overlaysOf(program).contains("loading map"));
    EXPECT_FALSE(overlaysOf(program).contains("crosshair"));
    expectGood(program.quit());
}

}  // namespace
}  // namespace terrane::app
