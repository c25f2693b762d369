// Reads the behaviors of a block of a content file. Called by block_parser.cpp.
#pragma once

#include "terrane/world/block_parser.h"
#include "terrane/world/content_table.h"

namespace terrane::world {

// Behaviors that other keys imply come first: the block's shape, growth and slots must be read before. Errors
// go to the table.
void readBehaviors(ContentTable& table, BlockDescription& block, const BehaviorTable& behaviors);

}  // namespace terrane::world
