// A store in memory, kept until the program ends.
#pragma once

#include "terrane/store/overlay_store.h"

namespace terrane::store {

class MemoryStore : public OverlayStore {
  public:
    explicit MemoryStore(WorldIdentity identity, SaveLimits limits = {});
};

}  // namespace terrane::store
