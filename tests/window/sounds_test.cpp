// The sound of a game, as OpenAL writes it to a file.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "terrane/sound/sound_player.h"
#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

constexpr std::size_t kHeaderBytes = 68;  // of OpenAL's WAV file

class SoundsTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        for (const char* variable : {"ALSOFT_DRIVERS", "PULSE_SERVER", "XDG_RUNTIME_DIR"})
            setenv(variable, "", 1);
        makeWorld("home", {{"camera", "8.5 8.5 82 0 -89"}, {"movement", "medium"}});
    }

    // The peak of the samples from the byte `since` on, 0 to 1.
    static double loudest(const std::string& file, std::size_t since) {
        double peak = 0;
        for (std::size_t at = std::max(since, kHeaderBytes) & ~std::size_t{3}; at + 2 <= file.size();
             at += 2) {
            std::int16_t sample = 0;
            std::memcpy(&sample, file.data() + at, sizeof sample);
            peak = std::max(peak, std::abs(static_cast<double>(sample)) / 32768);
        }
        return peak;
    }
};

TEST_F(SoundsTest, ABlockThatBreaksIsHeard) {
    const std::filesystem::path heard = folder() / "heard.wav", config = folder() / "alsoft.conf";
    write(config,
          "drivers = wave\nchannels = stereo\nsample-type = int16\n[wave]\nfile = " + heard.string() + "\n");
    setenv("ALSOFT_DRIVERS", "wave", 1);
    setenv("ALSOFT_CONF", config.c_str(), 1);
    Program program = play("home", {"--sound-volume", "1"});
    program.untilDrawn();
    program.tap(MouseButton::Left);  // captures the mouse
    program.until("sound", [&] {
        return loudest(textOf(heard), 0) > 0 || log().find("without sounds") != std::string::npos;
    });
    if (log().find("this build has no sounds") != std::string::npos) GTEST_SKIP() << "built without OpenAL";
    const std::size_t before = textOf(heard).size();
    const double wind = loudest(textOf(heard), 0);
    program.tap(MouseButton::Left);
    program.until("a loud sound", [&] { return loudest(textOf(heard), before) > std::max(0.1, 3 * wind); });
    EXPECT_EQ(program.blockAt(kGround), "air");
    expectGood(program.quit());
    EXPECT_EQ(log().find("without sounds"), std::string::npos);
}

TEST_F(SoundsTest, WithoutADeviceOneLineSaysSo) {
    if (sound::hasSoundCard()) GTEST_SKIP() << "this machine has a sound card";
    Program program = play("home", {"--sound-volume", "1"});
    program.until("a line", [&] { return log().find("without sounds: ") != std::string::npos; });
    expectGood(program.quit());
    const std::vector<std::string> lines = linesOf(folder() / "log.txt");
    const auto isOfSound = [](const std::string& line) {
        return line.find("sound") != std::string::npos || line.find("AL") != std::string::npos;
    };
    EXPECT_EQ(std::ranges::count_if(lines, isOfSound), 1) << log();
}

TEST_F(SoundsTest, Volume0OpensNothing) {
    Program program = play("home", {"--sound-volume", "0"});
    program.untilDrawn();
    program.frames(20);
    expectGood(program.quit());
    EXPECT_EQ(log().find("sounds"), std::string::npos);
}

}  // namespace
}  // namespace terrane::app
