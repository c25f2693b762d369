#include "apps/terrane/window/known_edits.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "terrane/base/files.h"

namespace terrane::app {

base::Result<void> writeKnownEdits(const std::filesystem::path& file, net::RemoteStore& store,
                                   const world::BlockRegistry& blocks, const world::Pose& pose, int reach) {
    const auto edited = TERRANE_TRY(store.editedChunks());
    const world::ChunkPos center = world::chunkOf(pose.position);
    std::string text = fmt::format("center {} {}\n", center.x, center.y);
    for (const world::ChunkPos pos : edited) {
        if (std::abs(pos.x - center.x) > reach || std::abs(pos.y - center.y) > reach) continue;
        for (const world::PlacedBlock& block : net::placedBlocks(pos, store.difference(pos)))
            text += fmt::format("{} {} {} {}\n", block.pos.x, block.pos.y, block.pos.z,
                                blocks.type(block.value.id).name);
    }
    return base::writeFile(file, text);
}

}  // namespace terrane::app
