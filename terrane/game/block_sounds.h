// The sounds that changes of blocks make. Plain data; plays nothing.
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

// The limit for one change with its consequences, so that large ones (undo, a falling tree) are no louder.
constexpr std::size_t kMaxSoundsAChange = 6;

// A removed block makes a sound of breaking; a placed block, also in place of another one, a sound of
// placing. A used block (a door) sounds as if placed; a change of data alone is silent. Liquids sound where a
// player places or takes them, not where they flow: `isPlayers` says whether it is a player's change.
std::vector<BlockSound> soundsOf(const world::BlockRegistry& blocks, std::span<const world::BlockEdit> edits,
                                 bool isPlayers);

}  // namespace terrane::game
