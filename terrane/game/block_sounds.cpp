#include "terrane/game/block_sounds.h"

#include <algorithm>
#include <optional>

#include "terrane/world/block_behavior.h"

namespace terrane::game {
namespace {

std::optional<BlockSound> soundOf(const world::BlockRegistry& blocks, const world::BlockEdit& edit,
                                  bool isPlayers) {
    using Kind = BlockSound::Kind;
    const world::BlockType &before = blocks.type(edit.before), &after = blocks.type(edit.after);
    const auto isFluid = [](const world::BlockType& type) {
        return type.id == world::kAir || type.shape == world::Shape::Liquid;
    };
    if (isFluid(before) && isFluid(after) && !isPlayers) return std::nullopt;
    if (edit.before == edit.after) {
        const bool isDoor = after.slots == 0 && world::behaviorWith(after, &world::BlockBehavior::used);
        return isDoor ? std::optional(BlockSound{Kind::Place, after.sound, edit.pos}) : std::nullopt;
    }
    const bool breaks = isFluid(after) && !isFluid(before);
    const bool takesLiquid = edit.after == world::kAir;
    const world::SoundMaterial material = breaks || takesLiquid ? before.sound : after.sound;
    // Water has no sound of breaking: taking a liquid sounds like placing it.
    const Kind kind = breaks && material != world::SoundMaterial::Water ? Kind::Break : Kind::Place;
    if (material == world::SoundMaterial::None) return std::nullopt;
    return BlockSound{kind, material, edit.pos};
}

}  // namespace

std::vector<BlockSound> soundsOf(const world::BlockRegistry& blocks, std::span<const world::BlockEdit> edits,
                                 bool isPlayers) {
    std::vector<BlockSound> sounds;
    for (const world::BlockEdit& edit : edits) {
        const auto sound = soundOf(blocks, edit, isPlayers);
        if (!sound) continue;
        // The two halves of a door make one sound.
        const bool isNew = std::ranges::none_of(sounds, [&](const BlockSound& other) {
            return other.kind == sound->kind && other.material == sound->material &&
                   other.pos.x == sound->pos.x && other.pos.y == sound->pos.y;
        });
        if (isNew) sounds.push_back(*sound);
        if (sounds.size() == kMaxSoundsAChange) break;
    }
    return sounds;
}

}  // namespace terrane::game
