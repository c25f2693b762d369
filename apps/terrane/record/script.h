// What a video shows, as read from a path file: shots one behind the other. Plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/terrane/graphics_options.h"
#include "terrane/view/camera_path.h"
#include "terrane/world/block_type.h"

namespace terrane::app {

// Times are seconds from the start of the shot.

// A text in the image.
struct TitleCue {
    double time = 0, seconds = 4;
    std::string text;
    bool isLarge = false;  // in the middle; else at the bottom
};

// Fills a box of blocks, all at once or one after the other: by z, y, x.
struct EditCue {
    double time = 0, seconds = 0;
    world::BlockBox box;
    world::BlockId block = world::kAir;
    std::string player = {};  // of the shot, who makes it; empty: nobody
};

// Somebody to be seen. The path's positions are where the feet are.
struct PlayerCue {
    std::string name;
    std::uint32_t number = 0;  // colors and hair follow from it
    view::CameraPath path;
};

// How things are drawn from then on.
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
    WorldOptions world;
    std::vector<Shot> shots;  // at least one
    double seconds() const { return shots.back().start + shots.back().seconds; }
};

// What is at a time is there for a frame of that time, whatever rounding made of both.
constexpr double kTimeSlack = 1e-6;

// The shot at a time of the video; the last one where it is over.
const Shot& shotAt(const Script& script, double seconds);
const GraphicsOptions& optionsAt(const Shot& shot, double secondsInShot);

}  // namespace terrane::app
