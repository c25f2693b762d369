#include "terrane/stream/chunk_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "terrane/stream/neighbourhood.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

constexpr int kNeighbours = 8;

template <class Use>
void forEachAround(ChunkPos pos, Use use) {
    for (const ChunkPos at : neighbourhood(pos)) {
        if (at != pos) use(at);
    }
}

// Square of the distance, of what lies behind up to twice.
std::int64_t urgencyOf(ChunkPos offset, glm::vec2 direction) {
    const auto x = static_cast<float>(offset.x), y = static_cast<float>(offset.y);
    const float distance = std::sqrt(x * x + y * y);
    const float ahead = distance > 0 ? (x * direction.x + y * direction.y) / distance : 1.0f;
    const float turned = direction == glm::vec2{} ? 0.0f : (1.0f - ahead) * 0.5f;
    return static_cast<std::int64_t>(16.0f * distance * distance * (1.0f + turned));
}

}  // namespace

ChunkTable::Entry& ChunkTable::entry(ChunkPos pos) {
    const auto found = entries_.find(pos);
    assert(found != entries_.end() && "the chunk is in the table");
    return found->second;
}

std::optional<ChunkStage> ChunkTable::stageAt(ChunkPos pos) const {
    const auto found = entries_.find(pos);
    return found != entries_.end() ? std::optional(found->second.stage) : std::nullopt;
}

bool ChunkTable::isAtLeastActive(ChunkPos pos) const {
    const auto found = entries_.find(pos);
    return found != entries_.end() && found->second.stage != ChunkStage::Loading;
}

std::int64_t ChunkTable::urgency(ChunkPos pos) const {
    return urgencyOf({pos.x - centre_.x, pos.y - centre_.y}, direction_);
}

bool ChunkTable::setView(ChunkPos centre, int viewDistance, glm::vec2 direction) {
    assert(viewDistance >= 0 && "a view shows at least the camera's chunk");
    const bool isSameOrder = viewDistance == viewDistance_ && direction == direction_;
    if (isSameOrder && centre == centre_) return false;
    centre_ = centre;
    viewDistance_ = viewDistance;
    direction_ = direction;
    if (!isSameOrder) orderOffsets();
    loadCursor_ = finishCursor_ = 0;
    wantedVisible_ = visibleInView_ = 0;
    for (const ChunkPos offset : offsets_) {
        const ChunkPos pos{centre_.x + offset.x, centre_.y + offset.y};
        if (!isInView(pos) || !world::isInWorld(pos)) continue;
        ++wantedVisible_;
        if (is(pos, ChunkStage::Visible)) ++visibleInView_;
    }
    return true;
}

void ChunkTable::orderOffsets() {
    const int reach = viewDistance_ + 1, side = 2 * reach + 1;
    offsets_.clear();
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) offsets_.push_back({x, y});
    }
    std::stable_sort(offsets_.begin(), offsets_.end(), [&](ChunkPos a, ChunkPos b) {
        return urgencyOf(a, direction_) < urgencyOf(b, direction_);
    });
    rank_.resize(offsets_.size());
    for (std::size_t k = 0; k < offsets_.size(); ++k) {
        rank_[static_cast<std::size_t>((offsets_[k].y + reach) * side + offsets_[k].x + reach)] = k;
    }
}

void ChunkTable::lookAgainFrom(ChunkPos pos, std::size_t& cursor) const {
    if (viewDistance_ < 0 || !isWanted(pos)) return;
    const int reach = viewDistance_ + 1, side = 2 * reach + 1;
    const int x = pos.x - centre_.x + reach, y = pos.y - centre_.y + reach;
    cursor = std::min(cursor, rank_[static_cast<std::size_t>(y * side + x)]);
}

void ChunkTable::request(ChunkPos pos, Time now) {
    assert(world::isInWorld(pos) && "only chunks of the world can be asked for");
    const auto found = entries_.find(pos);
    if (found != entries_.end()) {
        found->second.asked = now;
        found->second.isRequested = true;
    } else if (waiting_.insert(pos).second) {
        requests_.push_back(pos);
    }
}

std::vector<ChunkPos> ChunkTable::takeLoads(std::size_t limit) {
    std::vector<ChunkPos> taken;
    const auto take = [&](ChunkPos pos, bool isRequested) {
        if (!world::isInWorld(pos) || entries_.contains(pos)) return;
        Entry e;
        e.isRequested = isRequested;
        e.activeAround = countActiveAround(pos);
        entries_.emplace(pos, e);
        ++loading_;
        taken.push_back(pos);
    };
    for (; taken.size() < limit && !requests_.empty(); requests_.pop_front()) {
        waiting_.erase(requests_.front());
        take(requests_.front(), true);
    }
    for (; taken.size() < limit && loadCursor_ < offsets_.size(); ++loadCursor_) {
        const ChunkPos offset = offsets_[loadCursor_];
        take({centre_.x + offset.x, centre_.y + offset.y}, false);
    }
    return taken;
}

bool ChunkTable::mayGiveUpLoad(ChunkPos pos) const {
    const auto found = entries_.find(pos);
    return found != entries_.end() && found->second.stage == ChunkStage::Loading &&
           !found->second.isRequested && !isWanted(pos);
}

std::uint8_t ChunkTable::countActiveAround(ChunkPos pos) const {
    int count = 0;
    forEachAround(pos, [&](ChunkPos n) { count += !world::isInWorld(n) || isAtLeastActive(n) ? 1 : 0; });
    return static_cast<std::uint8_t>(count);
}

void ChunkTable::changeActiveAround(ChunkPos pos, int change) {
    forEachAround(pos, [&](ChunkPos n) {
        const auto found = entries_.find(n);
        if (found == entries_.end()) return;
        found->second.activeAround = static_cast<std::uint8_t>(found->second.activeAround + change);
        if (found->second.activeAround == kNeighbours) lookAgainFrom(n, finishCursor_);
    });
}

void ChunkTable::setStage(ChunkPos pos, Entry& e, ChunkStage stage) {
    loading_ -= e.stage == ChunkStage::Loading ? 1 : 0;
    finishing_ -= e.stage == ChunkStage::Finishing ? 1 : 0;
    if (isInView(pos) && e.stage == ChunkStage::Visible) --visibleInView_;
    e.stage = stage;
    finishing_ += stage == ChunkStage::Finishing ? 1 : 0;
    if (isInView(pos) && stage == ChunkStage::Visible) ++visibleInView_;
}

void ChunkTable::loaded(ChunkPos pos, Time now) {
    Entry& e = entry(pos);
    assert(e.stage == ChunkStage::Loading && "what arrives was asked for");
    e.asked = now;
    setStage(pos, e, ChunkStage::Active);
    changeActiveAround(pos, 1);
    lookAgainFrom(pos, finishCursor_);
}

void ChunkTable::loadEnded(ChunkPos pos) {
    assert(is(pos, ChunkStage::Loading) && "what ends was asked for");
    --loading_;
    entries_.erase(pos);
    lookAgainFrom(pos, loadCursor_);
}

std::vector<ChunkPos> ChunkTable::takeFinishes(std::size_t limit) {
    std::vector<ChunkPos> taken;
    bool isPrefix = true;  // all before this one are Finishing or Visible
    for (std::size_t k = finishCursor_; k < loadCursor_ && taken.size() < limit; ++k) {
        const ChunkPos pos{centre_.x + offsets_[k].x, centre_.y + offsets_[k].y};
        const auto found = entries_.find(pos);
        const bool isOfInterest = isInView(pos) && world::isInWorld(pos);
        if (isOfInterest && found != entries_.end() && found->second.stage == ChunkStage::Active &&
            found->second.activeAround == kNeighbours) {
            found->second.isOld = false;
            setStage(pos, found->second, ChunkStage::Finishing);
            taken.push_back(pos);
        } else if (isOfInterest && (found == entries_.end() || found->second.stage < ChunkStage::Finishing)) {
            isPrefix = false;
        }
        if (isPrefix) finishCursor_ = k + 1;
    }
    return taken;
}

bool ChunkTable::finished(ChunkPos pos) {
    Entry& e = entry(pos);
    assert(e.stage == ChunkStage::Finishing && "what is finished was taken");
    const bool isGood = !e.isOld && isWanted(pos);
    setStage(pos, e, isGood ? ChunkStage::Visible : ChunkStage::Active);
    if (!isGood) lookAgainFrom(pos, finishCursor_);
    return isGood;
}

void ChunkTable::blocksChanged(ChunkPos pos) {
    const auto mark = [&](ChunkPos n) {
        const auto found = entries_.find(n);
        if (found != entries_.end()) found->second.isOld = true;
    };
    mark(pos);
    forEachAround(pos, mark);
}

std::vector<ChunkPos> ChunkTable::takeHidden() {
    std::vector<ChunkPos> hidden;
    for (auto& [pos, e] : entries_) {
        if (e.stage != ChunkStage::Visible || isWanted(pos)) continue;
        setStage(pos, e, ChunkStage::Active);
        hidden.push_back(pos);
    }
    return hidden;
}

std::vector<ChunkPos> ChunkTable::takeUnloads(Time now) {
    std::vector<ChunkPos> unloaded;
    for (auto& [pos, e] : entries_) {
        if (viewDistance_ >= 0 && isWanted(pos)) e.asked = now;
        if (e.stage == ChunkStage::Active && now - e.asked >= kUnloadAfter) unloaded.push_back(pos);
    }
    for (const ChunkPos pos : unloaded) {
        entries_.erase(pos);
        changeActiveAround(pos, -1);
    }
    return unloaded;
}

}  // namespace terrane::stream
