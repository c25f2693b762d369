// The title screen's page to join a server: known servers, and fields for another. Immediate mode.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/terrane/window/game/remote_play.h"
#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/text.h"
#include "terrane/base/result.h"

namespace terrane::app {

// The servers that the player was on, the last one first: a text file with a line "HOST:PORT NAME" each,
// where NAME is the player's. One thread at a time.
struct PlayedServer {
    std::string server;  // HOST:PORT
    std::string name;    // of the player

    bool operator==(const PlayedServer&) const = default;
};

std::filesystem::path serverListFile(const std::filesystem::path& dataFolder);

// Skips malformed lines. Empty if there is no file.
std::vector<PlayedServer> readServers(const std::filesystem::path& file);

// Moves a server to the front. Creates the file and its folder.
[[nodiscard]] base::Result<void> rememberServer(const std::filesystem::path& file,
                                                const PlayedServer& played);
[[nodiscard]] base::Result<void> removeServer(const std::filesystem::path& file, const std::string& server);

class JoinDialog {
  public:
    explicit JoinDialog(std::filesystem::path listFile) : listFile_(std::move(listFile)) {}

    // Reads the list; the fields start with the last server.
    void open();

    enum class Outcome : std::uint8_t { None, Join, Back };
    Outcome draw(const Screen& screen, const Texts& tr);
    // The server and name to join, checked.
    const RemoteOptions& options() const { return options_; }

  private:
    void drawList(const Texts& tr);
    bool drawFields(const Texts& tr);
    bool check();
    void forget();

    std::filesystem::path listFile_;
    std::vector<PlayedServer> servers_;
    RemoteOptions options_;
    std::string problem_;  // error in the fields
};

}  // namespace terrane::app
