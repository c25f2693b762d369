#include "apps/terrane/record/edit_player.h"

#include <algorithm>
#include <cmath>

namespace terrane::app {

EditPlayer::EditPlayer(const Script& script) {
    for (const Shot& shot : script.shots)
        for (const EditCue& edit : shot.edits) edits_.push_back({&edit, shot.start + edit.time});
}

void EditPlayer::advanceTo(double seconds, game::Session& session) {
    for (Progress& progress : edits_) {
        const std::int64_t wanted = blocksDone(*progress.edit, seconds - progress.start);
        for (; progress.done < wanted; ++progress.done) {
            const world::BlockPos pos = progress.edit->box.blockAt(progress.done);
            session.pipeline().chunkAt(world::chunkOf(pos));
            session.edit({game::kNoPlayer, pos, world::SetBlock{progress.edit->block}, std::nullopt});
        }
    }
}

std::int64_t blocksDone(const EditCue& edit, double seconds) {
    if (seconds < -kTimeSlack) return 0;
    if (seconds + kTimeSlack >= edit.seconds) return edit.box.blockCount();
    const double share = (seconds + kTimeSlack) / edit.seconds;
    return static_cast<std::int64_t>(share * static_cast<double>(edit.box.blockCount()));
}

}  // namespace terrane::app
