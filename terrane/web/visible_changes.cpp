#include "terrane/web/visible_changes.h"

#include <nlohmann/json.hpp>

#include <exception>
#include <optional>
#include <set>
#include <utility>

namespace terrane::web {

namespace {

constexpr std::size_t kMaxBoxes = 200;

// A square of 2^shift chunks of a level along each side.
struct Square {
    std::int32_t x = 0, y = 0;  // in units of the square
    std::uint8_t level = 0;

    auto operator<=>(const Square&) const = default;
};

std::set<Square> squaresOf(std::span<const world::ChunkPos> chunks, int shift) {
    std::set<Square> squares;
    for (const world::ChunkPos chunk : chunks)
        squares.insert({chunk.x >> shift, chunk.y >> shift, chunk.level});
    return squares;
}

}  // namespace

std::string editEvent(std::uint64_t number, std::span<const world::ChunkPos> chunks) {
    int shift = 0;
    std::set<Square> squares = squaresOf(chunks, shift);
    while (squares.size() > kMaxBoxes) squares = squaresOf(chunks, ++shift);
    nlohmann::json boxes = nlohmann::json::array();
    for (const Square& square : squares) {
        const std::int64_t width = std::int64_t{world::kChunkSize} << (square.level + shift);
        boxes.push_back({{"level", square.level},
                         {"x0", square.x * width},
                         {"y0", square.y * width},
                         {"x1", (square.x + 1) * width - 1},
                         {"y1", (square.y + 1) * width - 1}});
    }
    return nlohmann::json{{"number", number}, {"boxes", std::move(boxes)}}.dump();
}

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

void VisibleChanges::add(std::span<const ChunkPos> chunks, const map::EditedPositions& before) {
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
std::vector<ChunkPos> VisibleChanges::visibleAmong(map::MapPainter& painter,
                                                   const std::vector<Change>& changes, Digests& digests) {
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

void VisibleChanges::examine() {
    if (isLooking_ && job_.state() == base::JobState::Failed) {  // out of memory
        isLooking_ = false;
        parts_.onVisible(looking_);
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
        std::vector<ChunkPos> seen = visibleAmong(painter, *changes, *digests);
        post([this, seen = std::move(seen), alive] {
            if (!*alive) return;
            isLooking_ = false;
            if (!seen.empty()) parts_.onVisible(seen);
        });
    });
}

}  // namespace terrane::web
