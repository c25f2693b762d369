// The contents of a video, as read from a path file: a sequence of shots. Plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/terrane/graphics_options.h"
#include "terrane/base/result.h"
#include "terrane/view/camera_path.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/blocks/block_type.h"
#include "terrane/world/blocks/content_table.h"
#include "terrane/world/coords.h"

namespace terrane::app {

// Times are seconds from the start of the shot.

// A text in the image.
struct TitleCue {
    double time = 0, seconds = 4;
    std::string text;
    bool isLarge = false;  // large in the middle; else small at the bottom
};

// Fills a box of blocks, at once or one by one, ordered by z, y, x.
struct EditCue {
    double time = 0, seconds = 0;
    world::BlockBox box;
    world::BlockId block = world::kAir;
    std::string player = {};  // a player of the shot who places them; empty: none
};

// A player in the image. The path's positions are those of the feet.
struct PlayerCue {
    std::string name;
    std::uint32_t number = 0;  // selects colors and hair
    view::CameraPath path;
};

// Graphics options from this time on.
struct OptionsCue {
    double time = 0;
    GraphicsOptions graphics;
};

struct Shot {
    std::string name;
    double start = 0, seconds = 0;  // start: from the beginning of the video
    view::CameraPath path;
    std::vector<OptionsCue> options;  // by time; the first is at 0
    std::vector<TitleCue> titles;
    std::vector<EditCue> edits;  // by time; they last until the end of the video
    std::vector<PlayerCue> players;
};

struct Script {
    io::WorldOptions world;
    std::vector<Shot> shots;  // at least one
    double seconds() const { return shots.back().start + shots.back().seconds; }
};

// Tolerance for rounding, in seconds: an event at the time of a frame is part of that frame.
constexpr double kTimeSlack = 1e-6;

// The shot at a time of the video; the last one after its end.
const Shot& shotAt(const Script& script, double seconds);
const GraphicsOptions& optionsAt(const Shot& shot, double secondsInShot);

}  // namespace terrane::app

// Reads values in the tables of a path file: numbers, positions, and values of command line flags.
namespace CLI {
class App;
}

namespace terrane::app {

using Names = std::vector<std::string>;

// Errors are stored in the table; `fallback` is then returned.

double numberOf(world::ContentTable& table, std::string_view key, double fallback, double min, double max);
// `form` names the expected form in errors.
std::optional<std::vector<double>> numbersOf(world::ContentTable& table, std::string_view key,
                                             std::size_t count, std::string_view form);
std::optional<world::BlockPos> blockPosOf(world::ContentTable& table, std::string_view key);

// Sets flags from keys of the same names, in the order of `names`, except those in `given`.
void applyFlags(world::ContentTable& table, CLI::App& flags, const Names& names, const Names& given);

}  // namespace terrane::app

namespace terrane::app {

// Reads path files (docs/video.md). Errors name the file, the line and the key.
// Options of the command line; they take precedence over the file.
struct ScriptDefaults {
    io::WorldOptions world;
    GraphicsOptions graphics;
    // Given flags without dashes: the file's options of these names are ignored; with a preset, all options
    // that it sets.
    std::vector<std::string> given;
};

// `name` stands for the file in errors.
base::Result<Script> parseScript(std::string_view toml, std::string_view name, const ScriptDefaults& defaults,
                                 const world::BlockRegistry& blocks);

}  // namespace terrane::app
