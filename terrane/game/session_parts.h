// The parts of a game::Session, and the authority that may decide in its place (session.h).
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "terrane/game/build_command.h"
#include "terrane/game/edit_command.h"
#include "terrane/game/edit_history.h"
#include "terrane/game/player_items.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/gen/level_generators.h"
#include "terrane/light/batch_lighter.h"
#include "terrane/store/chunk_store.h"
#include "terrane/stream/pipeline_types.h"
#include "terrane/stream/tile_pipeline.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::game {

// Passed to the constructor of Session.
struct SessionParts {
    std::shared_ptr<const world::BlockRegistry> blocks;  // not moved: others refer to it
    gen::LevelGenerators generators;                     // has level 0
    std::unique_ptr<store::ChunkStore> store;
    unsigned threads = 1;         // workers; 0: see Session::jobs()
    bool storesGenerated = true;  // chunks without edits too
    // Null: workers generate and light. Both outlive the session.
    gen::BatchGenerator* batchGenerator = nullptr;
    light::BatchLighter* batchLighter = nullptr;
    stream::MeshPolicy meshing = stream::MeshPolicy::Workers;
    // The store calls it with tiles that edits changed, on a thread of its own; it may be empty.
    stream::TileListener tileListener = {};
};

// A server that decides on players' commands for a session that shows its world. Edits are applied at once,
// before the decision; builds and undo wait for it. The server also advances time: plants and liquids change
// only by setBlocks().
struct Authority {
    std::function<void(const EditCommand&, std::span<const ChangedBlock> changed)> edited;
    std::function<void(const BuildCommand&)> build;
    std::function<void(PlayerId, HistoryWay)> undoOrRedo;
    std::function<void(const ItemAction&)> act;  // with the local player's items; they wait for it
};

}  // namespace terrane::game
