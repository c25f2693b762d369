// Joins a server from the window: waits, and asks about content packs that the client lacks. Used on the
// thread of the OpenGL context.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "apps/terrane/window/game/remote_play.h"
#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/text.h"
#include "apps/terrane/window/window.h"
#include "terrane/base/process.h"
#include "terrane/net/wire/server_message.h"

namespace terrane::app {

// Asks the player whether a server may send the content packs of its world. Immediate mode.
enum class PackAnswer : std::uint8_t { None, Accept, Refuse };

PackAnswer drawPackDialog(const Screen& screen, const Texts& tr, const std::string& server,
                          std::span<const net::PackOffer> packs);

// Returns once the player is in the server's world. Null if the player cancels; fails if the server cannot be
// reached or refuses. `language` as in settings; `dataFolder` has the player's key and the known servers.
base::Result<std::unique_ptr<RemotePlay>> joinServer(Window& window, const base::StopSignals& signals,
                                                     const std::string& language, RemoteOptions options,
                                                     const std::filesystem::path& dataFolder);

}  // namespace terrane::app
