// Draws the frames of a script in order. Before each frame everything in view is loaded, lit and meshed, and
// moving things are placed for the frame's time, so the frames do not depend on the machine's speed. Used on
// the thread of the OpenGL context.
#pragma once

#include <vector>

#include "apps/terrane/offscreen.h"
#include "apps/terrane/record/script.h"
#include "apps/terrane/record/title_painter.h"
#include "terrane/game/session.h"
#include "terrane/world/pose.h"

namespace terrane::app {

// Applies the edits of a script to the world, up to a time. The result does not depend on the frames drawn
// before. Used on the session's thread.
class EditPlayer {
  public:
    // The script outlives this.
    explicit EditPlayer(const Script& script);

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

// All parts outlive the recorder.
struct RecorderParts {
    const Script& script;
    Offscreen& world;
    const TitlePainter& titles;
    glm::ivec2 size;  // pixels
};

class Recorder {
  public:
    explicit Recorder(const RecorderParts& parts) : parts_(parts), edits_(parts.script) {}

    // The frame at `seconds` of the video, not before that of the last call.
    base::Result<base::Image> frame(double seconds);

  private:
    base::Result<void> apply(const GraphicsOptions& graphics);
    void warnOfBlocks(const render::Camera& camera, const Shot& shot, double secondsInShot);

    RecorderParts parts_;
    EditPlayer edits_;
    int viewDistance_ = 0;  // of the renderer
    const Shot* warnedOf_ = nullptr;
};

// The opacity of a title, 0…1, `seconds` after its start.
float titleStrength(const TitleCue& title, double seconds);

}  // namespace terrane::app
