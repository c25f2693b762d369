// Settings that are changed while one plays, the choice of a preset at the first start, textures and shaders.
#include <algorithm>

#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

using Lines = std::vector<std::string>;

class GraphicsTest : public WindowTest {
  protected:
    // The program without options that choose graphics.
    static Program startPlain(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(),
                         {"--debug-gl", "--size", "160x90", "--generator", "flat", "--sound-volume", "0"});
        return Program(arguments);
    }
    // An almost unlit texture in this color for the top of grass.
    static void writeGrass(const std::filesystem::path& folder, std::uint8_t red, std::uint8_t blue) {
        create_directories(folder);
        base::Image image{16, 16, {}};
        for (int k = 0; k < 16 * 16; ++k) image.rgba.insert(image.rgba.end(), {red, 0, blue, 255});
        EXPECT_TRUE(base::writePng(folder / "grass_top.png", image));
    }
    // The middle of the image.
    static glm::ivec3 color(Program& program) {
        const base::Image image = program.worldImage();
        const std::size_t at = 4 * static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2);
        return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2]};
    }
    void expectNamed(const std::string& settings, const std::string& hint) {
        write(folder() / "settings.toml", settings);
        Program program = startPlain({"--settings", (folder() / "settings.toml").string()});
        const base::Result<void> ended = program.untilEnd();
        ASSERT_FALSE(ended) << settings;
        EXPECT_NE(ended.error().message.find("settings.toml:1: " + hint), std::string::npos)
            << ended.error().message;
    }
};

TEST_F(GraphicsTest, TheFirstStartMeasuresWhichPresetToTake) {
    std::string preset;
    {
        Program program = startPlain({});
        program.until("the world is played", [&] { return program.isPlaying(); });
        EXPECT_TRUE(program.game().preset.isBusy());
        program.frames();
        EXPECT_EQ(program.window().vsync, Vsync::Off);
        program.until("the choice", [&] { return !program.game().preset.isBusy(); });
        program.frames(2);
        EXPECT_EQ(program.window().vsync, Vsync::On);
        preset = program.game().settings.preset;
        EXPECT_NE(log().find("graphics: " + preset + ", for "), std::string::npos);
        expectGood(program.quit());
        // Frames of the window of tests take 50 ms: without a graphics card even the cheapest preset is too
        // slow.
        if (preset == "minimal") {
            EXPECT_EQ(settingsLines(), (Lines{"hint-seen = 'true'", "horizon = '512'", "preset = 'minimal'",
                                              "view-distance = '8'"}));
        } else {
            EXPECT_EQ(settingsLines(), (Lines{"hint-seen = 'true'", "preset = '" + preset + "'"}));
        }
    }
    Program program = startPlain({});
    program.until("the world is played", [&] { return program.isPlaying(); });
    EXPECT_FALSE(program.game().preset.isBusy());
    EXPECT_EQ(program.game().settings.preset, preset);
    expectGood(program.quit());
}

TEST_F(GraphicsTest, AChosenPresetIsNotMeasured) {
    for (const std::vector<std::string>& chosen :
         {Lines{"--preset", "low"}, Lines{"--clouds", "off"}, Lines{"--settings", ""}}) {
        Program program = startPlain(chosen);
        program.until("the world is played", [&] { return program.isPlaying(); });
        EXPECT_FALSE(program.game().preset.isBusy()) << chosen[0];
        expectGood(program.quit());
        EXPECT_EQ(settingsLines(), chosen[0] == "--settings" ? Lines{} : Lines{"hint-seen = 'true'"})
            << chosen[0];
        std::filesystem::remove(data() / "settings.toml");
    }
}

TEST_F(GraphicsTest, FramesWaitForTheScreenAndTheLimit) {
    makeWorld("home");
    Program program = play("home", {"--frame-limit", "10", "--vsync", "adaptive"});
    program.untilDrawn();
    EXPECT_EQ(program.window().vsync, Vsync::Adaptive);
    // A frame takes 50 ms in the window of tests, of the 100 that the limit leaves.
    const double paused = program.window().pausedSeconds;
    EXPECT_GT(paused, 0);
    program.game().settings.frameLimit = 0;
    program.game().settings.vsync = Vsync::Off;
    program.frames(3);
    EXPECT_EQ(program.window().vsync, Vsync::Off);
    const double before = program.window().pausedSeconds;
    program.frames(3);
    EXPECT_EQ(program.window().pausedSeconds, before);
    expectGood(program.quit());
}

// Frames of the window of tests take 50 ms, whatever is drawn.
TEST_F(GraphicsTest, TheWorldIsDrawnSmallerWhereFramesTakeTooLong) {
    makeWorld("home");
    Program program = play("home");
    program.untilDrawn();
    const auto scale = [&] { return program.game().parts.renderer.options().renderScale; };
    program.frames(40);
    EXPECT_EQ(scale(), 100) << "without a rate to hold";
    const glm::ivec2 size = program.game().parts.renderer.size();
    program.game().settings.targetFps = 30;
    program.until("a smaller image", [&] { return scale() < 100; });
    EXPECT_EQ(program.game().parts.renderer.size(), size);
    EXPECT_EQ(program.worldImage().width, size.x);
    program.until("the full size, as a smaller one was no faster", [&] { return scale() == 100; });
    EXPECT_EQ(program.game().settings.graphics.render.renderScale, 100) << "the player's own";
    expectGood(program.quit());
}

TEST_F(GraphicsTest, OnlyChangesOfThePlayerAreKept) {
    write(data() / "settings.toml", "day-minutes = 3\n");
    {
        Program program = play("home", {"--clouds", "off"});
        program.untilDrawn();
        EXPECT_EQ(program.game().settings.dayMinutes, 3);
        expectGood(program.quit());
        EXPECT_EQ(settingsLines(), Lines{"day-minutes = 3"});
    }
    Program program = play("home", {"--clouds", "off", "--field-of-view", "80"});
    program.untilDrawn();
    program.press(Key::L);
    const bool isSmooth = program.game().settings.graphics.render.light == render::LightSampling::Smooth;
    expectGood(program.quit());
    EXPECT_EQ(settingsLines(),
              (Lines{"day-minutes = 3", isSmooth ? "light = 'smooth'" : "light = 'classic'"}));
}

TEST_F(GraphicsTest, FullScreenIsASetting) {
    write(data() / "settings.toml", "full-screen = true\n");
    Program program = play("home");
    program.untilDrawn();
    EXPECT_EQ(program.game().parts.renderer.size(), OffscreenWindow::kScreen);
    program.press(Key::F11);
    EXPECT_FALSE(program.window().isFullScreen);
    program.until("an image of the window's size",
                  [&] { return program.game().parts.renderer.size() == program.window().units; });
    expectGood(program.quit());
    EXPECT_EQ(settingsLines(), Lines{});
}

TEST_F(GraphicsTest, KeysDoNothingElseWhileOneTypes) {
    Program program = play("home");
    program.untilDrawn();
    program.press(Key::F2);
    program.hold(Key::Control);
    program.click("field-of-view");  // a number can be typed
    program.release(Key::Control);
    program.type("m9");
    program.press(Key::Enter);
    EXPECT_EQ(program.game().settings.movement, game::Movement::Walk);
    EXPECT_EQ(program.game().settings.fieldOfView, 40);  // the least
    program.press(Key::M);
    EXPECT_EQ(program.game().settings.movement, game::Movement::Fly);
    program.press(Key::Escape);
    expectGood(program.quit());
    EXPECT_EQ(settingsLines(), Lines{"field-of-view = '40'"});
}

TEST_F(GraphicsTest, AResourcePackIsLoadedWhileOnePlays) {
    makeWorld("home", {{"camera", kDown}, {"movement", "noclip"}});
    writeGrass(folder() / "pk", 255, 0);
    {
        Program program = play("home");
        program.untilDrawn();
        const glm::ivec3 before = color(program);
        EXPECT_GT(before.g, before.r);
        program.press(Key::F2);
        program.click("resource pack");
        program.type("no");
        program.press(Key::Enter);
        EXPECT_GT(program.game().notices.messageSeconds, 0);
        EXPECT_EQ(program.game().applied.resourcePack, "");
        program.click("resource pack");
        program.hold(Key::Control);
        program.press(Key::A);
        program.release(Key::Control);
        program.type("pk");
        program.press(Key::Enter);
        EXPECT_EQ(program.game().notices.message, "textures loaded");
        program.frames(2);
        const glm::ivec3 now = color(program);
        EXPECT_GT(now.r, 2 * std::max(now.g, now.b));
        program.press(Key::Escape);
        expectGood(program.quit());
        EXPECT_EQ(setting("home", "resource_pack"), (folder() / "pk").string());
    }
    // A world that lost its textures is shown with those of the program.
    remove_all(folder() / "pk");
    Program program = play("home");
    program.untilDrawn();
    EXPECT_GT(color(program).g, color(program).r);
    EXPECT_NE(log().find("; the world is shown without it"), std::string::npos);
    EXPECT_TRUE(program.quit());
}

TEST_F(GraphicsTest, ShadersAreReadAgainWhileOnePlays) {
    makeWorld("home", {{"camera", kDown}, {"movement", "noclip"}});
    const std::filesystem::path shaders = folder() / "root" / "terrane" / "render";
    const std::filesystem::path shader = shaders / "shading" / "shade.frag.glsl";
    const auto fill = [&](const std::string& color) {
        write(shader,
              "layout(location = 0) out vec4 picture;\nvoid main() { picture = vec4(" + color + "); }\n");
    };
    create_directories(shader.parent_path());
    create_directories(shaders / "frame");
    Program program = play("home", {"--shader-root", (folder() / "root").string()});
    program.untilDrawn();
    const glm::ivec3 kRed(255, 0, 0), kBlue(0, 0, 255);
    EXPECT_NE(color(program), kRed);
    fill("1, 0, 0, 1");
    program.until("a red image", [&] { return color(program) == kRed; });
    // A shader with errors is not used.
    const std::filesystem::path wrong = shaders / "frame" / "debug_view.frag.glsl";
    const std::string complaint = "debug_view.frag.glsl: the shader does not compile";
    write(wrong, "this is no shader\n");
    const auto lastComplaint = [&] { return log().rfind(complaint); };
    program.until("an error", [&] { return lastComplaint() != std::string::npos; });
    EXPECT_EQ(color(program), kRed);
    // Nor for other options: the light stays as it is, and the game continues.
    const auto light = [&] { return program.game().settings.graphics.render.light; };
    const render::LightSampling before = light();
    const std::size_t first = lastComplaint();
    program.press(Key::L);
    program.until("an error for other options", [&] { return lastComplaint() != first; });
    program.until("the former light", [&] { return light() == before; });
    std::filesystem::remove(wrong);
    fill("0, 0, 1, 1");
    program.until("a blue image", [&] { return color(program) == kBlue; });
    EXPECT_TRUE(program.quit());
}

TEST_F(GraphicsTest, TheInterfaceFollowsTheScreensScale) {
    Program program = play("home");
    program.untilDrawn();
    program.press(Key::F2);
    const auto width = [&] {
        const Widget& found = program.widget("view-distance");
        return found.max.x - found.min.x;
    };
    const float usual = width();
    program.window().scale = 2;
    program.window().units = {960, 600};
    program.frames(2);
    EXPECT_EQ(width(), 2 * usual);
    program.click("view-distance", {}, 0.2);
    EXPECT_NEAR(program.game().settings.graphics.viewDistance, 13, 3);
    // Systems whose units are larger than pixels scale by themselves.
    program.window().unitPixels = 2;
    program.window().units = {480, 300};
    program.frames(2);
    EXPECT_EQ(width(), usual);
    EXPECT_EQ(program.window().framebufferSize(), glm::ivec2(960, 600));
    program.press(Key::Escape);
    EXPECT_TRUE(program.quit());
}

TEST_F(GraphicsTest, WrongSettingsAreNamed) {
    expectNamed("clouds = 'many'", "clouds: ");
    expectNamed("cloud = 'on'", "cloud: ");
    expectNamed("clouds = ", "");
    expectNamed("view-distance = 1000", "view-distance: ");
}

}  // namespace
}  // namespace terrane::app
