#include "terrane/web/seen_changes.h"

#include <exception>
#include <optional>
#include <utility>

namespace terrane::web {

using world::ChunkPos;

namespace {

// No value if the surface cannot be read.
std::optional<std::uint64_t> digestOf(map::MapPainter& painter, ChunkPos pos,
                                      std::span<const map::EditedChunk> edited) {
    try {
        const auto digest = painter.surfaceDigest(pos, edited);
        return digest ? std::optional(*digest) : std::nullopt;
    } catch (const std::exception&) {  // out of memory
        return std::nullopt;
    }
}

}  // namespace

void SeenChanges::add(std::span<const ChunkPos> chunks, const map::EditedPositions& before) {
    for (const ChunkPos chunk : chunks) {
        added_.insert(chunk);
        // The tiles above a chunk are edited with it.
        for (ChunkPos pos = chunk; pos.level <= map::levelOf(map::kMinZoom) && !before.contains(pos);
             pos = {pos.x >> 1, pos.y >> 1, static_cast<std::uint8_t>(pos.level + 1)})
            generated_.insert(pos);
    }
}

// If unsure, counts as visible: chunks edited before the map started, unreadable ones, and all of a failed
// job.
std::vector<ChunkPos> SeenChanges::seenAmong(map::MapPainter& painter, const std::vector<Change>& changes,
                                             Digests& digests) {
    std::vector<ChunkPos> seen;
    for (const Change& change : changes) {
        const ChunkPos pos = change.chunk.pos;
        std::optional<std::uint64_t> before;
        if (const auto known = digests.find(pos); known != digests.end())
            before = known->second;
        else if (change.wasGenerated)
            before = digestOf(painter, pos, {});
        const auto now = digestOf(painter, pos, std::span(&change.chunk, 1));
        if (now) digests[pos] = *now;
        if (!now || !before || *before != *now) seen.push_back(pos);
    }
    return seen;
}

void SeenChanges::look() {
    if (isLooking_ && job_.state() == base::JobState::Failed) {  // out of memory
        isLooking_ = false;
        parts_.seen(looking_);
    }
    if (isLooking_ || added_.empty()) return;
    isLooking_ = true;
    looking_.assign(added_.begin(), added_.end());
    added_.clear();
    const auto changes = std::make_shared<std::vector<Change>>();
    for (map::EditedChunk& chunk : parts_.editedAmong(looking_)) {
        const bool wasGenerated = generated_.erase(chunk.pos) > 0;
        changes->push_back({std::move(chunk), wasGenerated});
    }
    // Before tiles, which should show the result.
    job_ = parts_.jobs.submit(-1, [this, changes, digests = digests_, alive = isAlive_,
                                   &painter = parts_.painter, post = parts_.post] {
        std::vector<ChunkPos> seen = seenAmong(painter, *changes, *digests);
        post([this, seen = std::move(seen), alive] {
            if (!*alive) return;
            isLooking_ = false;
            if (!seen.empty()) parts_.seen(seen);
        });
    });
}

}  // namespace terrane::web
