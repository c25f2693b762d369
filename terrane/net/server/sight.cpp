#include "terrane/net/server/sight.h"

#include <algorithm>
#include <tuple>

namespace terrane::net {
namespace {

// Cells as wide as the sight: all players in sight lie in 3 × 3 cells.
constexpr std::int64_t kCellSteps = static_cast<std::int64_t>(kLostBlocks * kPoseSteps);

std::int64_t cellOf(std::int64_t steps) {
    return steps >= 0 ? steps / kCellSteps : -((-steps + kCellSteps - 1) / kCellSteps);
}

std::uint64_t keyOf(std::int64_t cellX, std::int64_t cellY) {
    return static_cast<std::uint64_t>(cellX) << 32 | static_cast<std::uint32_t>(cellY);
}

// Converts to the units of PoseChange.
std::uint8_t coarseYaw(const WirePose& pose) {
    return static_cast<std::uint8_t>(pose.yaw >> 8);
}
std::int8_t coarsePitch(const WirePose& pose) {
    return static_cast<std::int8_t>(pose.pitch / kPitchStep);
}

}  // namespace

PlayerGrid::PlayerGrid(std::span<const PlayerAt> players) {
    for (const PlayerAt& player : players)
        cells_[keyOf(cellOf(player.pose.x), cellOf(player.pose.y))].push_back(&player);
}

std::vector<PlayerGrid::Near> PlayerGrid::around(const PlayerAt& center) const {
    std::vector<Near> near;
    const std::int64_t cellX = cellOf(center.pose.x), cellY = cellOf(center.pose.y);
    for (std::int64_t y = cellY - 1; y <= cellY + 1; ++y)
        for (std::int64_t x = cellX - 1; x <= cellX + 1; ++x) {
            const auto cell = cells_.find(keyOf(x, y));
            if (cell == cells_.end()) continue;
            for (const PlayerAt* player : cell->second) {
                if (player->id == center.id) continue;
                const double distance = distanceBetween(player->pose, center.pose);
                if (distance <= kLostBlocks) near.push_back({player, distance});
            }
        }
    const auto isNearer = [](const Near& a, const Near& b) {
        return std::tie(a.distance, a.player->id) < std::tie(b.distance, b.player->id);
    };
    const std::size_t count = std::min(near.size(), kMaxSeen);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(), isNearer);
    near.resize(count);
    return near;
}

std::uint16_t Sight::freeSlot() {
    if (freeSlots_.empty()) return slots_++;
    const std::uint16_t slot = freeSlots_.back();
    freeSlots_.pop_back();
    return slot;
}

SightChanges Sight::update(std::uint64_t tick, std::span<const PlayerGrid::Near> around) {
    SightChanges changes;
    for (const auto& [player, distance] : around) {
        const auto found = seen_.find(player->id);
        if (found == seen_.end()) {
            if (distance > kSightBlocks) continue;
            const std::uint16_t slot = freeSlot();
            seen_.insert({player->id, {slot, player->pose, tick, tick}});
            changes.appeared.push_back({slot, player});
            continue;
        }
        Seen& seen = found->second;
        seen.foundTick = tick;
        const WirePose& pose = player->pose;
        const bool swings = player->swungTick > seen.toldTick;
        const bool isSame = pose.x == seen.told.x && pose.y == seen.told.y && pose.z == seen.told.z &&
                            coarseYaw(pose) == coarseYaw(seen.told) &&
                            coarsePitch(pose) == coarsePitch(seen.told);
        if ((isSame && !swings) || tick - seen.toldTick < ticksBetweenPoses(distance)) continue;
        changes.poses.push_back({seen.slot, pose.x - seen.told.x, pose.y - seen.told.y, pose.z - seen.told.z,
                                 coarseYaw(pose), coarsePitch(pose), swings});
        seen.told = pose;
        seen.toldTick = tick;
    }
    std::erase_if(seen_, [&](const auto& entry) {
        if (entry.second.foundTick == tick) return false;
        changes.disappeared.push_back(entry.second.slot);
        freeSlots_.push_back(entry.second.slot);
        return true;
    });
    return changes;
}

}  // namespace terrane::net
