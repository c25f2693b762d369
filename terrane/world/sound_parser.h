// Reads the key `sound` of a block in a content file.
#pragma once

#include "terrane/world/block_type.h"
#include "terrane/world/content_table.h"

namespace terrane::world {

// By default water for liquids, grass for plants, else stone.
SoundMaterial readSound(ContentTable& table, Shape shape);

}  // namespace terrane::world
