// Reads which behaviors a block of a content file has. Called by block_parser.cpp.
#pragma once

#include "terrane/world/block_parser.h"
#include "terrane/world/content_table.h"

namespace terrane::world {

// Those that other keys stand for come first: the block's shape, growth and slots are read before. What is
// wrong goes to the table's error.
void readBehaviors(ContentTable& table, BlockDescription& block, const BehaviorTable& behaviors);

}  // namespace terrane::world
