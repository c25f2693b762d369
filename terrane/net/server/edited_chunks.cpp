#include "terrane/net/server/edited_chunks.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace terrane::net {

using world::ChunkPos;

struct EditedChunks::Results {
    std::mutex mutex;
    std::vector<Found> found;
};

namespace {

constexpr std::uint64_t kRetryAfter = 40;  // calls of update(): two seconds

// Difference between the generated and the saved chunk; no value if the store cannot be read now. A damaged
// chunk counts as unedited.
std::optional<ChunkDifference> savedDifference(const EditedChunks::Parts& parts, ChunkPos pos) {
    const store::LoadedChunk loaded = parts.store.load(pos);
    if (loaded.isUnreadable && !loaded.isOverBudget) return std::nullopt;
    if (loaded.state != store::LoadedChunk::State::Present) return ChunkDifference();
    return chunkDifference(parts.generators.generate(pos), *loaded.chunk);
}

}  // namespace

EditedChunks::EditedChunks(const Parts& parts) : parts_(parts), results_(std::make_shared<Results>()) {}

bool EditedChunks::add(ChunkPos chunk) {
    bool isNew = false;
    for (int level = 0; level <= world::kMaxLevel; ++level) {
        const ChunkPos pos{chunk.x >> level, chunk.y >> level, static_cast<std::uint8_t>(level)};
        if (!positions_[static_cast<std::size_t>(level)].insert(pos).second) break;  // so are all above
        isNew = true;
    }
    return isNew;
}

std::vector<ChunkPos> EditedChunks::within(ChunkPos middle, int radius) const {
    const auto& positions = positions_[middle.level];
    std::vector<ChunkPos> found;
    const auto width = static_cast<std::size_t>(2 * radius + 1);
    if (positions.size() < width * width) {
        for (const ChunkPos pos : positions)
            if (world::chunkDistance(pos, middle) <= radius) found.push_back(pos);
        return found;
    }
    for (const ChunkPos pos : world::chunksWithin(middle, radius))
        if (positions.contains(pos)) found.push_back(pos);
    return found;
}

const ChunkDifference* EditedChunks::maybeDifference(ChunkPos pos) {
    const auto [found, isNew] = known_.try_emplace(pos);
    Known& known = found->second;
    known.used = ++uses_;
    if (isNew) findDifference(pos, known);
    return known.isPending ? nullptr : &known.difference;
}

void EditedChunks::findDifference(ChunkPos pos, Known& known) {
    known.isPending = true;
    if (tailOf_ && pos.level == 0) known.difference = tailOf_(pos);
    blockCount_ += known.difference.size();
    submit(pos, known);
}

void EditedChunks::submit(ChunkPos pos, Known& known) {
    known.job = ++jobCount_;
    const auto work = [pos, job = known.job,
                       snapshot = pos.level == 0 ? parts_.world.maybeChunkAt(pos) : nullptr, &parts = parts_,
                       results = results_] {
        std::optional<ChunkDifference> difference =
            snapshot ? chunkDifference(parts.generators.generate(pos), *snapshot)
                     : savedDifference(parts, pos);
        const std::lock_guard lock(results->mutex);
        results->found.push_back({pos, job, std::move(difference)});
    };
    parts_.jobs.submit(pos.level, work);
}

void EditedChunks::onChanged(ChunkPos pos, const ChunkDifference& newer) {
    const auto found = known_.find(pos);
    if (found == known_.end()) return;
    const std::size_t before = found->second.difference.size();
    mergeInto(found->second.difference, newer);
    blockCount_ += found->second.difference.size() - before;
}

void EditedChunks::onTileChanged(ChunkPos tile) {
    const auto found = known_.find(tile);
    if (found == known_.end()) return;
    blockCount_ -= found->second.difference.size();
    known_.erase(found);  // the result of a running job is ignored
}

void EditedChunks::update() {
    std::vector<Found> found;
    {
        const std::lock_guard lock(results_->mutex);
        found.swap(results_->found);
    }
    ++updates_;
    for (Found& result : found) {
        const auto entry = known_.find(result.pos);
        if (entry == known_.end() || entry->second.job != result.job) continue;
        Known& known = entry->second;
        if (!result.difference) {
            unread_.push_back({result.pos, result.job, updates_ + kRetryAfter});
            continue;
        }
        blockCount_ -= known.difference.size();
        mergeInto(*result.difference, known.difference);
        known.difference = std::move(*result.difference);
        known.isPending = false;
        blockCount_ += known.difference.size();
    }
    retryUnread();
    if (blockCount_ > kMaxBlocks) forgetOld();
}

void EditedChunks::retryUnread() {
    std::erase_if(unread_, [&](const Unread& unread) {
        if (unread.retryAt > updates_) return false;
        const auto entry = known_.find(unread.pos);
        if (entry != known_.end() && entry->second.job == unread.job) submit(unread.pos, entry->second);
        return true;
    });
}

// Evicts the least recently used half.
void EditedChunks::forgetOld() {
    std::vector<std::uint64_t> uses;
    for (const auto& [pos, known] : known_) uses.push_back(known.used);
    const auto middle = uses.begin() + static_cast<std::ptrdiff_t>(uses.size() / 2);
    std::ranges::nth_element(uses, middle);
    std::erase_if(known_, [&, limit = *middle](const auto& entry) {
        const Known& known = entry.second;
        if (known.isPending || known.used > limit) return false;
        blockCount_ -= known.difference.size();
        return true;
    });
}

}  // namespace terrane::net
