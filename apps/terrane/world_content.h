// The content packs that a command works with: those that --content names, and those that a world that is
// there was made with.
#pragma once

#include "apps/terrane/option_values.h"
#include "terrane/pack/content.h"

namespace terrane::app {

// The built-in pack, those of `options.content`, and those that the world of `save` remembers. Of the latter
// one that is not in the packs folder is left out, with a line in the log.
[[nodiscard]] base::Result<pack::Content> loadContent(const WorldOptions& options,
                                                      const SaveOptions& save = {});

// The same with all packs of the packs folder that can be used: what a player may choose from. What cannot be
// used is left out, with a line in the log.
[[nodiscard]] base::Result<pack::Content> loadInstalledContent(const WorldOptions& options);

}  // namespace terrane::app
