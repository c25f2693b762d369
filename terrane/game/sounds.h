// The ambient sounds at a place: wind and water.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/changes/block_edit.h"
#include "terrane/world/character.h"
#include "terrane/world/world.h"

namespace terrane::game {

struct Ambience {
    float wind = 0, water = 0;          // volumes, 0 to 1
    std::optional<glm::dvec3> waterAt;  // the nearest surface; none: under water, or no water
};

// Returns the ambient sounds at `ears`. Wind grows with height over the sea and with the share of open sky.
// Water is heard within kWaterReach blocks of its surface, louder where it flows. Reads up to 2,200 blocks: a
// few times a second is enough.
constexpr int kWaterReach = 12;
Ambience ambienceAt(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& ears,
                    int seaLevel);

// The sounds that changes of blocks make. Plain data; plays nothing.
struct BlockSound {
    enum class Kind : std::uint8_t { Break, Place };
    Kind kind = Kind::Break;
    world::SoundMaterial material = world::SoundMaterial::None;
    world::BlockPos pos;

    bool operator==(const BlockSound&) const = default;
};

// The limit for one change with its consequences, so that large ones (undo, a falling tree) are no louder.
constexpr std::size_t kMaxSoundsPerChange = 6;

// Returns the sounds of edits. A removed block makes a sound of breaking; a placed block, also in place of
// another one, a sound of placing. A used block (a door) sounds as if placed; a change of data alone is
// silent. Liquids sound where a player places or takes them, not where they flow: `isPlayers` says whether it
// is a player's change.
std::vector<BlockSound> soundsOf(const world::BlockRegistry& blocks, std::span<const world::BlockEdit> edits,
                                 bool isPlayers);

// A sound of a player on foot: a step, a landing, a stroke in water.
struct FootEvent {
    enum class Kind : std::uint8_t { Step, Land, Climb, Splash, Swim };
    Kind kind = Kind::Step;
    float strength = 1;  // 0 to 1

    bool operator==(const FootEvent&) const = default;
};

class Footsteps {
  public:
    // Returns the event since the last call; one at most. A character that was teleported makes no sound.
    std::optional<FootEvent> advance(const world::Character& now);
    // Discards the last character, for example after the player flew.
    void reset() { before_.reset(); }

  private:
    std::optional<world::Character> before_;
    double sinceStep_ = 0;  // blocks
    double fallSpeed_ = 0;  // in the last frame in the air, blocks/s
};

// Returns the block under the feet, also at its edge; air if there is none.
world::BlockId groundUnder(const world::World& world, const world::BlockRegistry& blocks, glm::dvec3 feet);

}  // namespace terrane::game
