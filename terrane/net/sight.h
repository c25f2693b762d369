// Which other players a client sees, and when it is told how they moved: near ones often, far ones rarely,
// those that stand still never. Plain bookkeeping on the server's thread; it sends nothing itself.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/game/edit_command.h"
#include "terrane/net/wire_pose.h"

namespace terrane::net {

// Blocks. A player appears within the first and disappears beyond the second, so that nobody at the edge
// comes and goes.
constexpr double kSightBlocks = 256, kLostBlocks = 288;
// The nearest count.
constexpr std::size_t kMaxSeen = 128;

// A player's place is told so many ticks after the last time at the latest, by its distance. Ticks are 50 ms:
// within 24 blocks what one sees is at most 100 ms old on the server, at the edge of sight a second.
constexpr std::uint64_t kTicksPerSight = 2;  // how often a client's sight is updated
constexpr std::uint64_t ticksBetweenPoses(double distanceBlocks) {
    return distanceBlocks < 24 ? 2 : distanceBlocks < 64 ? 4 : distanceBlocks < 128 ? 10 : 20;
}

struct PlayerAt {
    game::PlayerId id = game::kNoPlayer;
    WirePose pose;
    std::uint64_t swungTick = 0;  // of its last edit; 0: none
};

// All players by place, so that those around a point are found without looking at all. Made anew each tick.
class PlayerGrid {
  public:
    explicit PlayerGrid(std::span<const PlayerAt> players);

    struct Near {
        const PlayerAt* player = nullptr;
        double distance = 0;  // blocks
    };
    // Up to kMaxSeen others within kLostBlocks, the nearest first; of equally far ones the lower number.
    std::vector<Near> around(const PlayerAt& center) const;

  private:
    std::unordered_map<std::uint64_t, std::vector<const PlayerAt*>> cells_;
};

// What a client is told.
struct SightChanges {
    struct Appeared {
        std::uint16_t slot = 0;
        const PlayerAt* player = nullptr;
    };
    std::vector<Appeared> appeared;
    std::vector<std::uint16_t> disappeared;
    std::vector<PoseChange> poses;
};

// Of one client: whom it sees, and what it was told of each.
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
