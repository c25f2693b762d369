// Decides which other players a client sees, and when it is told how they moved: near ones often, far ones
// rarely, players that stand still never. Plain bookkeeping on the server's thread; it sends nothing itself.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/game/edit_command.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {

// In blocks. A player appears within the first distance and disappears beyond the second; the hysteresis
// prevents flicker at the edge.
constexpr double kSightBlocks = 256, kLostBlocks = 288;
// Only the nearest players are seen.
constexpr std::size_t kMaxSeen = 128;

// Interval in ticks between two poses of a moving player, by its distance. With ticks of 50 ms, a pose
// is at most 100 ms old on the server within 24 blocks, and a second at the edge of sight.
constexpr std::uint64_t kTicksPerSight = 2;  // interval between calls of Sight::update()
constexpr std::uint64_t ticksBetweenPoses(double distanceBlocks) {
    return distanceBlocks < 24 ? 2 : distanceBlocks < 64 ? 4 : distanceBlocks < 128 ? 10 : 20;
}

struct PlayerAt {
    game::PlayerId id = game::kNoPlayer;
    WirePose pose;
    std::uint64_t swungTick = 0;  // tick of the last edit; 0: none
};

// All players in a spatial hash grid, to find those near a point. Rebuilt each tick.
class PlayerGrid {
  public:
    explicit PlayerGrid(std::span<const PlayerAt> players);

    struct Near {
        const PlayerAt* player = nullptr;
        double distance = 0;  // blocks
    };
    // Up to kMaxSeen other players within kLostBlocks, nearest first; ties by lower id.
    std::vector<Near> around(const PlayerAt& center) const;

  private:
    std::unordered_map<std::uint64_t, std::vector<const PlayerAt*>> cells_;
};

// Changes to send to a client.
struct SightChanges {
    struct Appeared {
        std::uint16_t slot = 0;
        const PlayerAt* player = nullptr;
    };
    std::vector<Appeared> appeared;
    std::vector<std::uint16_t> disappeared;
    std::vector<PoseChange> poses;
};

// The players that one client sees, and the last pose sent of each.
class Sight {
  public:
    SightChanges update(std::uint64_t tick, std::span<const PlayerGrid::Near> around);
    std::size_t seenCount() const { return seen_.size(); }

  private:
    struct Seen {
        std::uint16_t slot = 0;
        WirePose told;
        std::uint64_t toldTick = 0, foundTick = 0;
    };
    std::uint16_t freeSlot();

    std::unordered_map<game::PlayerId, Seen> seen_;
    std::vector<std::uint16_t> freeSlots_;
    std::uint16_t slots_ = 0;  // in use or free
};

}  // namespace terrane::net
