// Keeps the items of a single player and the mode of the world in the world's store. Each change of items is
// passed to the store in one transaction with the blocks that changed until then. On the world's thread.
#pragma once

#include <string>

#include "terrane/game/session.h"

namespace terrane::game {

class ItemKeeper {
  public:
    // Reads the items and the mode; the session outlives this.
    explicit ItemKeeper(Session& session);

  private:
    void queue();

    Session& session_;
    bool isChanged_ = false;  // since the items were passed to the store
    Subscription changed_, saving_;
};

}  // namespace terrane::game
