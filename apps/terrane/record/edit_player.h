// Makes the edits of a script in the world, up to a time. The edits at a time are the same whatever frames
// came before. Used on the session's thread.
#pragma once

#include <vector>

#include "apps/terrane/record/script.h"
#include "terrane/game/session.h"

namespace terrane::app {

class EditPlayer {
  public:
    // The script outlives this.
    explicit EditPlayer(const Script& script);

    // `seconds` of the video, not before those of the last call.
    void advanceTo(double seconds, game::Session& session);

  private:
    struct Progress {
        const EditCue* edit;
        double start;           // seconds of the video
        std::int64_t done = 0;  // blocks
    };
    std::vector<Progress> edits_;
};

// How many blocks of an edit are made after some seconds of it.
std::int64_t blocksDone(const EditCue& edit, double seconds);

}  // namespace terrane::app
