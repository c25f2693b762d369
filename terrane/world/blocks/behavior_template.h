// Templates of behaviors that a block names with parameters:
//   behaviors = [{ name = "touched_becomes", by = "water", block = "rust" }]
// A template makes a BlockBehavior from the arguments of a block. All are plain values; any thread may use
// them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "terrane/world/blocks/block_behavior.h"

namespace terrane::world {

struct BehaviorParameter {
    enum class Kind : std::uint8_t { Block, Number };
    std::string name;
    Kind kind = Kind::Block;
    double min = 0, max = 0;  // of a number
};

struct BehaviorArguments {
    std::map<std::string, std::string, std::less<>> blocks;  // names of blocks that exist
    std::map<std::string, double, std::less<>> numbers;
};

struct BehaviorTemplate {
    std::string name;                           // a-z, 0-9, _
    std::vector<BehaviorParameter> parameters;  // a block gives all of them
    std::function<BlockBehavior(const BehaviorArguments&)> make;
};

using BehaviorTemplatePtr = std::shared_ptr<const BehaviorTemplate>;

// One block's use of a template.
struct BehaviorCall {
    BehaviorTemplatePtr behavior;
    BehaviorArguments arguments;
    int line = 0;  // in the file of the block
};

// Returns the behavior of a call. Its name holds the arguments, so that two programs can compare the behavior
// of blocks: "touched_becomes(block=rust,by=water)".
BlockBehavior behaviorOf(const BehaviorCall& call);

// used_becomes     block: a player who uses the block turns it into that one
// touched_becomes  by, block: the block becomes `block` when `by` comes to one of its six sides
std::vector<BehaviorTemplate> builtInTemplates();

}  // namespace terrane::world
