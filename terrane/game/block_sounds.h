// Which sounds changes of blocks make. Plain data: who plays them lies elsewhere.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/world/block_edit.h"

namespace terrane::game {

struct BlockSound {
    enum class Kind : std::uint8_t { Break, Place };
    Kind kind = Kind::Break;
    world::SoundMaterial material = world::SoundMaterial::None;
    world::BlockPos pos;

    bool operator==(const BlockSound&) const = default;
};

// Of one change with all that follows from it: large ones (undo, a tree that falls) sound no louder.
constexpr std::size_t kMaxSoundsAChange = 6;

// A block that goes breaks, one that comes is placed; in place of another one both are one sound. What is
// used (a door) knocks, what only keeps other data is silent. Liquids are heard where a player places or
// takes them, not where they flow: `isPlayers` says whose change it is.
std::vector<BlockSound> soundsOf(const world::BlockRegistry& blocks, std::span<const world::BlockEdit> edits,
                                 bool isPlayers);

}  // namespace terrane::game
