// Edits that are not relit yet: each block once, as it was before the first of its edits.
#pragma once

#include <vector>

#include "terrane/world/block_edit.h"
#include "terrane/world/block_set.h"

namespace terrane::stream {

struct PendingEdits {
    std::vector<world::BlockEdit> edits;
    world::BlockSet blocks;

    void add(const world::BlockEdit& edit) {
        if (blocks.insert(edit.pos)) edits.push_back(edit);
    }
};

}  // namespace terrane::stream
