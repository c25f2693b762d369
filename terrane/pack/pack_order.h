// The order in which packs are loaded. Any thread.
#pragma once

#include <vector>

#include "terrane/pack/pack.h"

namespace terrane::pack {

// `builtIn` first, then each pack after those that it requires, otherwise as given. An error if a pack is
// given twice, requires a missing one, or requires itself through others.
[[nodiscard]] base::Result<std::vector<Pack>> inOrder(Pack builtIn, std::vector<Pack> packs);

}  // namespace terrane::pack
