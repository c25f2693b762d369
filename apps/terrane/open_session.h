// The world that the command line names, opened for a command: its store and its generator.
#pragma once

#include <memory>

#include "apps/terrane/option_values.h"
#include "apps/terrane/world_content.h"
#include "terrane/game/session.h"
#include "terrane/store/open_world.h"

namespace terrane::app {

// Of a world that is made by the options.
store::WorldIdentity identityOf(const WorldOptions& options, const pack::Content& content);

// Null where no world is named. Else `options` get its seed and generator; the world is refused, and left as
// it is, where they ask for others. A world that is not there is made, but for ReadOnly.
base::Result<std::unique_ptr<store::ChunkStore>> openSave(
    WorldOptions& options, const SaveOptions& save, store::WorldAccess access, const pack::Content& content,
    store::WorldSharing sharing = store::WorldSharing::Alone);

// The graph of level 0.
base::Result<gen::GeneratorGraph> makeGraph(const WorldOptions& options, const pack::Content& content);
base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const pack::Content& content);

struct OpenedWorld {
    pack::Content content;
    game::SessionParts parts;  // with the content's blocks
};

// What a session is made of, with workers for everything. Without a named world edits last until the program
// ends. `options` get the seed and generator of the world.
base::Result<OpenedWorld> openSessionParts(WorldOptions& options, const SaveOptions& save,
                                           store::WorldAccess access,
                                           store::WorldSharing sharing = store::WorldSharing::Alone);

}  // namespace terrane::app
