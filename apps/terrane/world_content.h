// The content packs of a command: those of --content, and those that an existing world was made with.
#pragma once

#include "apps/terrane/option_values.h"
#include "terrane/pack/content.h"

namespace terrane::app {

// The built-in pack, the packs of `options.content`, and those that the world of `save` remembers. A
// remembered pack that is not in the packs folder is skipped with a line in the log.
[[nodiscard]] base::Result<pack::Content> loadContent(const WorldOptions& options,
                                                      const SaveOptions& save = {});

// The same with all usable packs of the packs folder, for the player to choose from. Others are skipped with
// a line in the log.
[[nodiscard]] base::Result<pack::Content> loadInstalledContent(const WorldOptions& options);

}  // namespace terrane::app
