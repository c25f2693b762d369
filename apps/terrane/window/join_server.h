// Joins a server from the window: waits, and asks about content packs that the client lacks. Used on the
// thread of the OpenGL context.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "apps/terrane/window/remote_play.h"
#include "apps/terrane/window/window.h"
#include "terrane/base/stop_signals.h"

namespace terrane::app {

// Returns once the player is in the server's world. Null if the player cancels; fails if the server cannot be
// reached or refuses. `language` as in settings; `dataFolder` has the player's key and the known servers.
base::Result<std::unique_ptr<RemotePlay>> joinServer(Window& window, const base::StopSignals& signals,
                                                     const std::string& language, RemoteOptions options,
                                                     const std::filesystem::path& dataFolder);

}  // namespace terrane::app
