// Behaviors of blocks beyond their appearance and light: a behavior is a table of functions, named by the
// block types that have it (`behaviors` in assets/blocks.toml). Users of the library add their own to a
// BehaviorTable before they read the block types. See docs/blocks.md.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_type.h"
#include "terrane/world/blocks/inventory.h"
#include "terrane/world/coords.h"

namespace terrane::world {

class BlockRegistry;
class BlockUpdate;  // block_edit.h
class World;

// The values of a block before it was replaced.
struct RemovedBlock {
    BlockId id = kAir;
    std::uint16_t state = 0;
    BlockEntityData data;
};

// Empty functions do nothing. All are called on the world's thread, while an edit is applied. Functions with
// a BlockUpdate change blocks only through it: light, meshes and saves see these changes as parts of the
// edit. They depend only on blocks, so that equal edits give equal worlds.
struct BlockBehavior {
    std::string name;  // a-z, 0-9, _
    // Returns whether the block can stand at `pos`. If not, it is not placed.
    std::function<bool(const World&, const BlockRegistry&, BlockPos pos, BlockId id)> canStand = {};
    // Called when an edit or a behavior has placed the block; not for generated terrain and loaded chunks.
    std::function<void(BlockUpdate&, BlockPos pos)> placed = {};
    // Called when another block, which is now at `pos`, has replaced it.
    std::function<void(BlockUpdate&, BlockPos pos, const RemovedBlock&)> removed = {};
    // Called when the block beside it on `side` has changed.
    std::function<void(BlockUpdate&, BlockPos pos, Face side)> neighborChanged = {};
    // Called when a player uses the block, for example opens a door.
    std::function<void(BlockUpdate&, BlockPos pos)> used = {};
    // Called at random, every 68 s on average, while the block's state is not 0 (random_ticks.h).
    std::function<void(BlockUpdate&, BlockPos pos)> tick = {};
    // Returns the items that the block holds; a block whose behavior has this can be opened. Returns an error
    // if its data is no inventory.
    std::function<base::Result<Inventory>(const World&, const BlockRegistry&, BlockPos pos)> items = {};
};

using BehaviorPtr = std::shared_ptr<const BlockBehavior>;
struct BehaviorTemplate;  // behavior_template.h

class BehaviorTable {
  public:
    // Both functions replace a behavior with the same name.
    void add(BlockBehavior behavior);
    void addTemplate(BehaviorTemplate behavior);
    BehaviorPtr find(std::string_view name) const;  // null if there is none
    std::shared_ptr<const BehaviorTemplate> findTemplate(std::string_view name) const;
    std::vector<std::string_view> names() const;  // of both kinds

  private:
    std::vector<BehaviorPtr> behaviors_;
    std::vector<std::shared_ptr<const BehaviorTemplate>> templates_;
};

// plant      needs ground: a full block, or its own kind (cactus); it is removed with the block below
// crop       is placed at its youngest stage of growth and grows by ticks; its state counts the stages left
// falling    falls through air and liquids when it is placed or when the block below changes
// flows      makes a liquid flow (liquid_flow.h)
// container  holds BlockType::slots stacks of items
// workbench  players craft on it in a grid of 3×3
// and those of block_behavior.h; with parameters those of behavior_template.h
const BehaviorTable& builtInBehaviors();

bool hasBehavior(const BlockType& type, std::string_view name);

// Returns the first behavior of a type that has the function; null if none has.
template <class Function>
const BlockBehavior* behaviorWith(const BlockType& type, Function BlockBehavior::*function) {
    for (const BehaviorPtr& behavior : type.behaviors)
        if ((*behavior).*function) return behavior.get();
    return nullptr;
}

// Behaviors of blocks whose shape is a model (block_model.h): supports, arms toward neighbors, doors.
// stands           is removed with the block below; if upside down, with the one above
// leans            is removed with the block at which it leans, in the direction of its facing
// stands_or_leans  leans in its other form and stands otherwise
// connects         has arms toward opaque cubes and blocks that connect, too
// opens            changes to its other form and back when it is used
// door             opens; NAME and NAME_top are its halves, placed, removed and opened together
std::vector<BlockBehavior> shapeBehaviors();

// isUpperHalf() returns whether the block is the upper half of a door. otherHalf() returns the other half of
// a door; air if it has none.
bool isUpperHalf(const BlockType& type);
BlockId otherHalf(const BlockRegistry& blocks, BlockId id);

// The position and direction at which a player builds a block.
struct Placement {
    Face face = kFacePosZ;   // of the block that it builds against
    float heightInCell = 0;  // of the spot on that face, 0…1
    float yaw = 0;           // degrees, of the player's look
};

// Returns the state of a block that is built: it faces where the player looks, or the wall at which it leans,
// and is upside down if built under a block or against the upper half of a side.
std::uint16_t placedState(const BlockType& type, const Placement& placement);

}  // namespace terrane::world
