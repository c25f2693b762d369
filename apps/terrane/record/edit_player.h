// Applies the edits of a script to the world, up to a time. The result does not depend on the frames drawn
// before. Used on the session's thread.
#pragma once

#include <vector>

#include "apps/terrane/record/script.h"
#include "terrane/game/session.h"

namespace terrane::app {

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

}  // namespace terrane::app
