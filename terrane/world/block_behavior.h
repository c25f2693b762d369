// What blocks do beside being drawn and lit: a behavior is a table of functions, named by the block types
// that have it (`behaviors` in assets/blocks.toml). Users of the library add their own to a BehaviorTable
// before they read the block types. See docs/blocks.md.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/block_type.h"
#include "terrane/world/coords.h"
#include "terrane/world/inventory.h"

namespace terrane::world {

class BlockRegistry;
class BlockUpdate;  // block_edit.h
class World;

// A block as it was before it was replaced.
struct RemovedBlock {
    BlockId id = kAir;
    std::uint16_t state = 0;
    BlockEntityData data;
};

// Functions that are empty do nothing. All are called on the world's thread, while an edit is applied. Those
// with a BlockUpdate change blocks through it and nothing else: light, meshes and saves see these changes as
// parts of the edit. They depend on nothing but blocks, so that equal edits give equal worlds.
struct BlockBehavior {
    std::string name;  // a-z, 0-9, _
    // Whether the block can stand at `pos`. Where it cannot, it is not placed.
    std::function<bool(const World&, const BlockRegistry&, BlockPos pos, BlockId id)> canStand = {};
    // The block was put there by an edit or a behavior. Generated terrain and loaded chunks call nothing.
    std::function<void(BlockUpdate&, BlockPos pos)> placed = {};
    // It was replaced by another block. `pos` has that one.
    std::function<void(BlockUpdate&, BlockPos pos, const RemovedBlock&)> removed = {};
    // The block beside it on `side` changed.
    std::function<void(BlockUpdate&, BlockPos pos, Face side)> neighborChanged = {};
    // A player uses the block, as one opens a door.
    std::function<void(BlockUpdate&, BlockPos pos)> used = {};
    // Time passes: at random, every 68 s on average, while the block's state is not 0 (random_ticks.h).
    std::function<void(BlockUpdate&, BlockPos pos)> tick = {};
    // The items that the block holds; a block whose behavior has this opens. An error where its data is none.
    std::function<base::Result<Inventory>(const World&, const BlockRegistry&, BlockPos pos)> items = {};
};

using BehaviorPtr = std::shared_ptr<const BlockBehavior>;
struct BehaviorTemplate;  // behavior_template.h

class BehaviorTable {
  public:
    // Takes the place of one with the same name.
    void add(BlockBehavior behavior);
    void addTemplate(BehaviorTemplate behavior);
    BehaviorPtr find(std::string_view name) const;  // null where there is none
    std::shared_ptr<const BehaviorTemplate> findTemplate(std::string_view name) const;
    std::vector<std::string_view> names() const;  // of both kinds

  private:
    std::vector<BehaviorPtr> behaviors_;
    std::vector<std::shared_ptr<const BehaviorTemplate>> templates_;
};

// plant      needs ground: a full block, or its own kind (cactus); it goes when the block below goes
// crop       is placed at its youngest stage of growth and grows by ticks; its state counts the stages left
// falling    falls through air and liquids when it is placed or when the block below goes
// flows      of a liquid: it flows (liquid_flow.h)
// container  holds BlockType::slots stacks of items
// and those of shape_behaviors.h; with parameters those of behavior_template.h
const BehaviorTable& builtInBehaviors();

bool hasBehavior(const BlockType& type, std::string_view name);

// The first behavior of a type that has the function; null where none has.
template <class Function>
const BlockBehavior* behaviorWith(const BlockType& type, Function BlockBehavior::*function) {
    for (const BehaviorPtr& behavior : type.behaviors)
        if ((*behavior).*function) return behavior.get();
    return nullptr;
}

}  // namespace terrane::world
