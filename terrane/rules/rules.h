// Rules of content packs: runs their scripts (scripts/NAME.lua, docs/scripting.md) for a session that
// decides, that of a single player or of a server. Each pack has a sandbox of its own
// (terrane/lua/sandbox.h), whose limits hold for a tick. A pack whose script fails is suspended: its
// handlers, timers and commands end, with one line in the log and in the chat of operators; everything else
// goes on. On the world's thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/pack/content.h"
#include "terrane/pack/pack.h"

namespace terrane::rules {

struct RulesHost;  // rules_internal.h

class Rules {
  public:
    // Runs the scripts of the packs, in the order of loading, each pack's by name. The session outlives this.
    // `logs`: whether problems are logged.
    Rules(game::Session& session, const std::vector<pack::Pack>& packs, bool logs = true);
    ~Rules();  // ends all handlers, timers and commands
    Rules(const Rules&) = delete;
    Rules& operator=(const Rules&) = delete;

    // Returns the reasons of suspended packs, "isles/scripts/gold.lua:3: …", in the order in which they
    // failed.
    const std::vector<std::string>& problems() const;

  private:
    std::unique_ptr<RulesHost> host_;
};

// Runs the scripts once in a small world of their own and returns the first error.
[[nodiscard]] base::Result<void> checkScripts(const pack::Content& content);

// Returns the names of all functions and members that scripts can use, sorted: "world.set", "Player:say",
// "Player.name". Tests compare them with the documentation.
std::vector<std::string> ruleFunctions();

}  // namespace terrane::rules
