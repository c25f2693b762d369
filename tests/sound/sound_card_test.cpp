#include "terrane/sound/sound_player.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/base/temp_folder.h"

namespace terrane::sound {
namespace {

class SoundCard : public testing::Test {
  protected:
    SoundCard() {
        for (const char* variable : {"ALSOFT_DRIVERS", "PULSE_SERVER"}) ::unsetenv(variable);
        ::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    }
    void add(const std::string& name) { std::ofstream(folder_.path() / name) << ""; }
    bool hasOne() const { return hasSoundCard(folder_.path()); }

    base::TempFolder folder_;
};

TEST_F(SoundCard, APlaybackDeviceIsOne) {
    EXPECT_FALSE(hasOne());
    EXPECT_FALSE(hasSoundCard(folder_.path() / "missing"));
    for (const char* name : {"timer", "seq", "controlC0", "pcmC0D0c"}) add(name);
    EXPECT_FALSE(hasOne()) << "a microphone and timers";
    add("pcmC0D0p");
    EXPECT_TRUE(hasOne());
}

TEST_F(SoundCard, AServerIsOne) {
    std::filesystem::create_directory(folder_.path() / "pulse");
    add("pulse/native");
    EXPECT_TRUE(hasOne());
}

TEST_F(SoundCard, VariablesNameOne) {
    ::setenv("PULSE_SERVER", "tcp:far", 1);
    EXPECT_TRUE(hasOne());
    ::setenv("PULSE_SERVER", "", 1);
    EXPECT_FALSE(hasOne());
    ::setenv("ALSOFT_DRIVERS", "null", 1);
    EXPECT_TRUE(hasOne());
}

}  // namespace
}  // namespace terrane::sound
