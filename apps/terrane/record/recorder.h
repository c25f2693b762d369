// Draws the frames of a script in order. Before each frame everything in view is loaded, lit and meshed, and
// moving things are placed for the frame's time, so the frames do not depend on the machine's speed. Used on
// the thread of the OpenGL context.
#pragma once

#include "apps/terrane/offscreen.h"
#include "apps/terrane/record/edit_player.h"
#include "apps/terrane/record/script.h"
#include "apps/terrane/record/title_painter.h"

namespace terrane::app {

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
