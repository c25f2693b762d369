// Draws the frames of a video in order. Before each frame everything in view is loaded, lit and meshed, and
// moving things are placed for the frame's time, so the frames do not depend on the machine's speed. Used on
// the thread of the OpenGL context.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/game/session.h"
#include "terrane/view/eye.h"
#include "terrane/view/offscreen.h"
#include "terrane/view/shots.h"
#include "terrane/world/pose.h"

namespace terrane::view {

// Applies the edits of a video to the world, up to a time. The result does not depend on the frames drawn
// before. Used on the session's thread.
class EditPlayer {
  public:
    // The shots outlive this.
    explicit EditPlayer(std::span<const Shot> shots);

    // `seconds`: time in the video, not before that of the last call.
    void advanceTo(double seconds, game::Session& session);

  private:
    struct Progress {
        const EditCue* edit;
        double start;           // seconds of the video
        std::int64_t done = 0;  // blocks
    };
    std::vector<Progress> edits_;
};

// The number of blocks of an edit that are set `seconds` after its start.
std::int64_t blocksDone(const EditCue& edit, double seconds);

// Computes the figures of a shot's players at a time. Pure; any thread.
// One figure per player, in the order of the shot. Walking is simulated from the start of the shot in fixed
// steps, so it does not depend on the frame rate or on the first frame of the video. An arm swings during the
// player's edits.
std::vector<world::Figure> figuresAt(const Shot& shot, double secondsInShot);

// Draws a title into an image; `strength` is its opacity, 0…1.
using PaintTitle = std::function<void(base::Image& image, const TitleCue& title, float strength)>;

// The shots and the world outlive the recorder.
struct RecorderParts {
    std::span<const Shot> shots;  // at least one
    Offscreen& world;
    glm::ivec2 size;             // pixels
    PaintTitle paintTitle = {};  // empty: no titles
};

class Recorder {
  public:
    explicit Recorder(RecorderParts parts) : parts_(std::move(parts)), edits_(parts_.shots) {}

    // The frame at `seconds` of the video, not before that of the last call.
    base::Result<base::Image> frame(double seconds);

  private:
    base::Result<void> apply(const OptionsCue& graphics);
    void warnOfBlocks(const render::Camera& camera, const Shot& shot, double secondsInShot);

    RecorderParts parts_;
    EditPlayer edits_;
    int viewDistance_ = 0;  // of the renderer
    const Shot* warnedOf_ = nullptr;
    Eye eye_;
    const Shot* seenShot_ = nullptr;  // its last frame was at seenSeconds_
    double seenSeconds_ = 0;
};

// The opacity of a title, 0…1, `seconds` after its start.
float titleStrength(const TitleCue& title, double seconds);

}  // namespace terrane::view
