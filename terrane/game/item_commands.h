// The commands /give and /mode of the chat, for single players and servers. On the world's thread.
#pragma once

#include <map>
#include <string>

#include "terrane/game/session.h"

namespace terrane::game {

// Who may give commands about items and modes.
using MayCommand = std::function<bool(PlayerId)>;

class ItemCommands {
  public:
    // Adds the commands to the session, which outlives this.
    ItemCommands(Session& session, MayCommand may);
    ~ItemCommands();
    ItemCommands(const ItemCommands&) = delete;
    ItemCommands& operator=(const ItemCommands&) = delete;

  private:
    std::string give(PlayerId player, const std::string& arguments);
    std::string setMode(PlayerId player, const std::string& arguments);

    Session& session_;
    MayCommand may_;
    std::map<PlayerId, std::string> names_;  // of players in the game
    Subscription joined_, left_;
};

}  // namespace terrane::game
