// The fixture of tests that play: a folder for worlds and settings, which is the working directory as well,
// and the program's log. Skipped where no OpenGL context can be made.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "tests/base/temp_folder.h"
#include "tests/window/program.h"

namespace terrane::app {

class WindowTest : public testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;

    // The program at its title, or in a world that the arguments name; small and fast.
    Program start(std::vector<std::string> arguments = {});
    // In the flat world of this name, or of the save, once it is drawn.
    Program play(const std::string& name, std::vector<std::string> arguments = {});

    // A world with a flat ground of grass on earth at z = 80, and with this metadata.
    void makeWorld(const std::string& name, const std::map<std::string, std::string>& metadata = {});
    std::filesystem::path worldFile(const std::string& name) const;
    std::vector<std::string> worldNames() const;
    // Of a world that is not played.
    std::string setting(const std::string& name, const std::string& key) const;
    std::string savedBlock(const std::string& name, world::BlockPos pos) const;

    std::filesystem::path folder() const { return temporary_.path(); }
    std::filesystem::path data() const { return folder() / "terrane"; }  // of worlds and settings
    std::vector<std::string> settingsLines() const;           // of the settings file, without comments
    std::string log() const;                                  // of this test
    void expectGood(const base::Result<void>& result) const;  // and no error or warning in the log

    bool showsHint_ = false;  // the hint of the first start

  private:
    base::TempFolder temporary_;
    std::filesystem::path before_;  // working directory
    int errorOutput_ = -1;          // standard error of the test program
};

// The lines of a file.
std::vector<std::string> linesOf(const std::filesystem::path& file);
std::string textOf(const std::filesystem::path& file);
void write(const std::filesystem::path& file, const std::string& text);

// Straight down on the ground at 8,8, from four blocks above it.
inline const char* const kDown = "8.5 8.5 84 0 -89";
constexpr world::BlockPos kGround{8, 8, 80};

}  // namespace terrane::app
