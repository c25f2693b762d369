// Draws the frames of a script one after the other: for each, everything in view is loaded, lit and meshed
// first, and what moves is where it is at the frame's time. So a script has the same frames however fast the
// machine is. Used on the thread of the OpenGL context.
#pragma once

#include "apps/terrane/offscreen.h"
#include "apps/terrane/record/edit_player.h"
#include "apps/terrane/record/script.h"
#include "apps/terrane/record/title_painter.h"

namespace terrane::app {

// All outlive the recorder.
struct RecorderParts {
    const Script& script;
    Offscreen& world;
    const TitlePainter& titles;
    glm::ivec2 size;  // pixels
};

class Recorder {
  public:
    explicit Recorder(const RecorderParts& parts) : parts_(parts), edits_(parts.script) {}

    // The frame at a time of the video, not before that of the last call.
    base::Result<base::Image> frame(double seconds);

  private:
    base::Result<void> apply(const GraphicsOptions& graphics);
    void warnOfBlocks(const render::Camera& camera, const Shot& shot, double secondsInShot);

    RecorderParts parts_;
    EditPlayer edits_;
    int viewDistance_ = 0;  // that the renderer has room for
    const Shot* warnedOf_ = nullptr;
};

// 0…1: how much of a title is to be seen after some seconds of it.
float titleStrength(const TitleCue& title, double seconds);

}  // namespace terrane::app
