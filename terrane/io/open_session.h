// Opens a world from plain settings: its content packs, its store and its generators.
#pragma once

#include <memory>

#include "terrane/game/session_parts.h"
#include "terrane/io/world_options.h"
#include "terrane/pack/content.h"
#include "terrane/store/saves/open_world.h"

namespace terrane::io {

// The built-in pack, the packs of `options.content`, and those that the world of `save` remembers. A
// remembered pack that is not in the packs folder is skipped with a line in the log.
[[nodiscard]] base::Result<pack::Content> loadContent(const WorldOptions& options,
                                                      const SaveOptions& save = {});

// The same with all usable packs of the packs folder, for the player to choose from. Others are skipped with
// a line in the log.
[[nodiscard]] base::Result<pack::Content> loadInstalledContent(const WorldOptions& options);

// The identity of a new world made with these options. Fails as gen::heightsOf().
base::Result<store::WorldIdentity> identityOf(const WorldOptions& options, const pack::Content& content);

// The heights of the world that openSave() would open or create. Fails as identityOf().
base::Result<world::Heights> heightsOfWorld(const WorldOptions& options, const SaveOptions& save,
                                            const pack::Content& content);

// Opens the named world, creating it unless access is ReadOnly; null if none is named. Fails, and leaves the
// world unchanged, if `options` ask for another seed, generator or heights; sets them in `options` to the
// world's.
base::Result<std::unique_ptr<store::ChunkStore>> openSave(
    WorldOptions& options, const SaveOptions& save, store::WorldAccess access, const pack::Content& content,
    store::WorldSharing sharing = store::WorldSharing::Alone);

// The generator of one level, 0…world::kMaxLevel, and its graph.
base::Result<gen::GeneratorGraph> makeGraph(const WorldOptions& options, const pack::Content& content,
                                            int level = 0);
base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const pack::Content& content,
                                           int level = 0);

struct OpenedWorld {
    pack::Content content;
    game::SessionParts parts;  // with the content's blocks
};

// The parts of a session that uses workers for all jobs. Without a named world edits are lost at exit. Sets
// seed, generator and heights in `options` to the world's.
base::Result<OpenedWorld> openSessionParts(WorldOptions& options, const SaveOptions& save,
                                           store::WorldAccess access,
                                           store::WorldSharing sharing = store::WorldSharing::Alone);

}  // namespace terrane::io
