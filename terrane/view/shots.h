// The contents of a video: a sequence of shots along camera paths, with titles, edits and players. Plain
// values.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "terrane/render/frame/frame_uniforms.h"
#include "terrane/render/frame/graphics_table.h"
#include "terrane/view/camera_path.h"
#include "terrane/world/blocks/block_type.h"
#include "terrane/world/coords.h"

namespace terrane::view {

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
    CameraPath path;
};

// Graphics from this time on.
struct OptionsCue {
    double time = 0;
    render::GraphicsChoices choices;
    render::View view = render::View::Color;
};

struct Shot {
    std::string name;
    double start = 0, seconds = 0;  // start: from the beginning of the video
    CameraPath path;
    std::vector<OptionsCue> options;  // by time; the first is at 0
    std::vector<TitleCue> titles;
    std::vector<EditCue> edits;  // by time; they last until the end of the video
    std::vector<PlayerCue> players;
};

// Tolerance for rounding, in seconds: an event at the time of a frame is part of that frame.
constexpr double kTimeSlack = 1e-6;

// The shot at a time of the video; the last one after its end. At least one shot.
const Shot& shotAt(std::span<const Shot> shots, double seconds);
const OptionsCue& optionsAt(const Shot& shot, double secondsInShot);

}  // namespace terrane::view
